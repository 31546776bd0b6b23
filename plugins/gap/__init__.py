"""The gap between model and machine: where it lies, which effects cause it, how far it shrinks."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("gap")
