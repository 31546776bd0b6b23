"""Design of the next experiment: safe motions that distinguish the remaining rival causes.

``next_experiment`` chooses among the motions of ``safe_tests`` the one on which rivals differ most.
The pipeline, the command line and the Gap panel use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
