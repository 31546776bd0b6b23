"""The blind test in the panel, and practice with hidden machines.

``blind_page`` is the dialog, and ``blind_run`` runs the test of ``app/blind`` in a separate
process. Only the Gap panel uses this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
