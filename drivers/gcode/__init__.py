"""GRBL stages by G-code, and an emulated one.

The serial line carries GRBL's dialect.
"""
