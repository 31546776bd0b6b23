"""Robot files.

They describe a machine's axes.
"""
