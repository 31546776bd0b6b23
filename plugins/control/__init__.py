"""Control menu of the micro and nano stages."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("control")
