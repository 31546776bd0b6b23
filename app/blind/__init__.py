"""Sealed self-test of the diagnosis.

The diagnosis runs as a separate process that sees only records.
"""
