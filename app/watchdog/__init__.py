"""A process that reports hangs.

It also reports that the program has died.
"""
