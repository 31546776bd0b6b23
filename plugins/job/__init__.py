"""The running job, its progress, and its pause and stop buttons."""

from rotemina.app.shell.language import texts_of

tr, _ = texts_of("job")
