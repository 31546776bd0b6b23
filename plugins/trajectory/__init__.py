"""The Trajectory panel: load a trajectory, check it in a dry run, and play it.

``teach_view`` makes trajectories from taught points, and ``path_view`` shows the tip's path. The
folder exports the play button, which other panels show as well.
"""

import lazy_loader

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("trajectory")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
