"""Panel for the compensation of hysteresis.

The operator trains, checks and applies an inverse model, and tunes a control loop around it. The
inverse models are in ``sim/compensate``, and the search for gains is in ``sim/tuning``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("compensation")
