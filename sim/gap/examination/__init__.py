"""Examination of the axes: screening, fits, selection, and the order of the axes.

``examination`` treats one axis: it sets disturbances aside, fits effects and selects causes. Only
the pipeline and the design of experiments use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
