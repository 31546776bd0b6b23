"""Cameras in use: one thread each, and its newest picture for everybody."""
