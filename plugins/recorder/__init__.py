"""Session recordings and library.

Record, recover, list, export and replay sessions.
"""
