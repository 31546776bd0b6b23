"""Session recordings and library.

Record, recover, list, export and replay sessions.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("recorder")
