"""Inverse models of a piezo.

They undo hysteresis, creep and lag; they are trained, checked and run by sample.
"""
