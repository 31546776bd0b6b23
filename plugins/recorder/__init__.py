"""Panel to record sessions, and to recover, list, export and replay recordings.

Each part of the panel is one module. The recordings themselves are in ``app/motion/recording``, and
the library of records is in ``app/records``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("recorder")
