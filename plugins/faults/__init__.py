"""The Faults panel: the fault history, and fault injection for training.

``fault_history`` keeps the history, ``fault_catalogue`` lists what a virtual board can simulate,
and ``board_process`` runs such a board next to the window.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("faults")
