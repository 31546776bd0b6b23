"""The Effects panel: switch, adjust, load and save the effects of the running simulator.

``chosen_effects`` and ``live_changes`` do the work without widgets; the other modules show it. The
effects themselves are in ``sim/effects``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("effects")
