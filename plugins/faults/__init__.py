"""Past faults, and fault injection for training."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("faults")
