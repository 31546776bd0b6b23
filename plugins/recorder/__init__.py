"""Recorder: sessions recorded, recovered, listed, exported and shown again."""
