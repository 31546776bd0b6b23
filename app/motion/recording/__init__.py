"""Crash-safe recording of sessions; reading, export and replay of recordings.

``session_recorder`` writes a recording in segments, ``recovery`` joins those of a crashed program,
``recording_reader`` reads on demand, and ``replay`` shows a recording like a live session. Window,
command line and the Recorder panel use it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
