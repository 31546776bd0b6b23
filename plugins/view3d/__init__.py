"""The robot in three dimensions, model and real as two ghosts."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("view3d")
