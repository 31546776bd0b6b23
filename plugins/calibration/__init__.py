"""Panel for sensor calibration.

It guides an operator through the procedure, shows the errors before and after, and switches stored
calibrations on and off. The procedure itself is in ``app/calibration``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("calibration")
