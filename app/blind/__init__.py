"""Runs the sealed self-test: the diagnosis as a process of its own, on records alone."""
