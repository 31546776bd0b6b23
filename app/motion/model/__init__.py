"""The models that run along with a machine: the nominal one and the one in use.

``live_models`` runs them on the commands that the device has applied, and ``model_in_use`` says
which model makes predictions. The session and the comparison of runs use it. The equations are in
``sim/plant``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
