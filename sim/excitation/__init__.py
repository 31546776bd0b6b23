"""Test motions inside the limits."""
