"""Crash-safe recording of sessions.

Recordings are read back, exported and replayed.
"""
