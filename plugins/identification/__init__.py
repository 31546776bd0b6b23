"""Identification from a record.

Frequency response, loop, steps, fitted model and health card.
"""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("identification")
