"""Teleoperation, with an on-screen pad.

Mode, scaling and the device in control.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("teleoperation")
