"""Test motions inside the limits.

Each motion makes one property of a machine visible.
"""
