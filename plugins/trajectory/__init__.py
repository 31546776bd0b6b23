"""Trajectories: load, dry run, play."""

from rotemina.app.shell.language import texts_of

tr, mark = texts_of("trajectory")
