"""The built-in simulator.

It is a motion driver like any other.
"""
