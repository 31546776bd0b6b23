"""Per-axis time plots of command, model and measurement."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("plots")
