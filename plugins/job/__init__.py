"""The running job and its progress.

The panel also has the buttons that pause and stop it.
"""

from rotemina.app.shell.language import texts_of

tr, _ = texts_of("job")
