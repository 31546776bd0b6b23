"""Modes, state space, stability."""
