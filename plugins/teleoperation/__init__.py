"""Panel for teleoperation: the device in control, mode, scaling, and an on-screen pad.

``virtual_stick`` turns keys and pointer into deflections, and ``scale_editor`` changes the scales.
The folder exports texts about the device in control, which other panels show as well.
"""

import lazy_loader

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("teleoperation")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
