"""Excitations: test motions that make one property of a machine visible, inside its limits."""
