"""Cases of the sealed self-test.

They are made by equations that the diagnosis does not know.
"""
