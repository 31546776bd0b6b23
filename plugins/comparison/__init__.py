"""Panel that compares the model with a record of the machine.

It has a table of all taps, and plots of one. The figures come from ``sim/comparison``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("comparison")
