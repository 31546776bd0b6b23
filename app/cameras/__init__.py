"""Cameras in use: one thread each, with the newest picture available to all readers."""
