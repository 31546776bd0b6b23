"""Modes, state space, stability.

They hold for small motions of a machine.
"""
