"""Translations of the window.

Qt reads one ``.qm`` file per language. The ``.ts`` files are the sources of these files.
"""
