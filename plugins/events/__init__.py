"""The operator's log: moves, stops, refusals.

It also lists locks and runs.
"""

from rotemina.app.shell.language import texts_of

tr, _ = texts_of("events")
