"""Comparison of the model with a real record."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("comparison")
