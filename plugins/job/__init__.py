"""The running job and its progress.

The panel also has the buttons that pause and stop it.
"""
