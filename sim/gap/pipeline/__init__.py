"""The diagnosis as a whole, from records to conclusions.

``diagnosis_pipeline`` runs all steps, and ``conclusions`` turns findings into causes and figures.
The command line and the Gap panel start a diagnosis here; no other step imports it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
