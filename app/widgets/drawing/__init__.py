"""Plots with their legends, and drawings of tip positions.

``plot`` has the plot that all panels use, in the window's colours; ``tip_frame`` draws the tip with
its bounds from above or from the side. Window and panels use this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
