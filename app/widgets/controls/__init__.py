"""Buttons, combo boxes and number fields: tooltips, reasons for being disabled, safe wheels.

``enable_unless`` disables a button and states the reason, and ``ChangingButton`` changes its
meaning safely, as *Play* and *Pause* do. Fields ignore the mouse wheel. Window and panels use this
folder.
"""

import lazy_loader

from rotemina.sim.compatibility import add_names_of_former_module

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__getattr__ = add_names_of_former_module(__getattr__, "rotemina.app.widgets.controls.controls")
