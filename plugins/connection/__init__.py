"""Device, its settings, conditions for motion."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("connection")
