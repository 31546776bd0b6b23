"""Microscope panel: the picture, and motion by the microscope."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("microscope")
