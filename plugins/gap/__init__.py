"""The Gap diagnosis panel.

It shows where the recorded machine deviates from its model (the gap), which effects cause this, and
how much of the gap a corrected model closes. ``diagnosing`` starts a diagnosis, ``answer`` shows
its result, and ``blind`` tests it. The diagnosis itself is in ``sim/gap``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("gap")
