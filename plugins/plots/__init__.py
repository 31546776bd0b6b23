"""Live plots of each axis.

Command, model and measurement over time.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("plots")
