"""Input devices and their set-up.

Connected devices, their readings and their functions.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("inputs")
