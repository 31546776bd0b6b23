"""The microscope picture, and motion by it."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("microscope")
