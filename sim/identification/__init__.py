"""Identification of models from records.

Frequency responses, parametric models, natural modes, and figures of step responses and hysteresis.
The modules are methods, from ``welch`` and ``arx`` to ``vector_fitting``. The Identification panel,
the health cards and the diagnosis use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
