"""Gap diagnosis and correction.

Where the gap is, which effects cause it, and how far it shrinks.
"""
