"""Model and real robot in 3-D."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("view3d")
