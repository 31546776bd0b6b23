"""Identification from a record: frequency response, loop, steps, a fitted model."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("identification")
