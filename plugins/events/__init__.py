"""The operator's log: moves, stops, locks, refusals and runs."""

from rotemina.app.shell.language import texts_of

tr, _ = texts_of("events")
