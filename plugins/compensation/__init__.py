"""Compensation of hysteresis.

Train, check and apply an inverse, and tune a loop around it.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("compensation")
