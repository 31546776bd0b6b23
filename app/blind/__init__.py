"""Self-test with sealed labels: the diagnosis runs in a separate process that sees only records.

``self_test`` has cases of the generators in ``sim`` diagnosed, and scores the answers; naive
methods answer the same cases for comparison. ``hidden_machine`` is for practice in the window. The
command ``rotemina gap blind`` and the blind test of the Gap panel use this folder.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
