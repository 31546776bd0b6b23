"""Modes, state space and stability of a machine in small motion."""
