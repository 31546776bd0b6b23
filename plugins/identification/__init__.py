"""The Identification panel: what a record tells about an axis.

It shows the frequency response, the hysteresis loop, the step responses, a fitted model, and the
health card, whose figures show wear. Each analysis is one module; its method is in
``sim/identification``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("identification")
