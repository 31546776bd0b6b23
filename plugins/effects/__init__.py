"""Effects of the running simulator.

Switch, tune, load and save them.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("effects")
