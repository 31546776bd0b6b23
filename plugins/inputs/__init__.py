"""Input devices: connected ones, their readings, their functions, and their set-up."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("inputs")
