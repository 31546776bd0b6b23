"""Checks of incoming records: clocks, units, stuck sensors, duplicates, time leaps.

``record_checks`` runs all checks; each other module is one of them. A record that cannot be
diagnosed is refused here, before anything is fitted. Every step of a diagnosis may use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
