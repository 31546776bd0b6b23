"""Automatic cell penetration.

Parameters, their consequences, the run and the log.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("penetration")
