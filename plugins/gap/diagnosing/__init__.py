"""The start of a diagnosis: records, model, and the process that runs it.

``start_section`` is what the operator sees. ``diagnosis_process`` and ``diagnosis_worker`` run the
diagnosis outside the window. Only the Gap panel uses this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
