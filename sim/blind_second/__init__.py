"""A second generator of cases.

It has none of the first one's equations.
"""
