"""Effects, one module each.

An effect is what a real axis adds to the nominal plant.
"""
