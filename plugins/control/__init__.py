"""Control menu of both stages."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("control")
