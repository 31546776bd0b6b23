"""The Events panel: the operator's log of moves, stops, locks, refusals and runs.

``journal`` keeps the entries without Qt, and ``panel`` shows them, newest first.
"""

from rotemina.app.language import make_text_functions

tr, _ = make_text_functions("events")
