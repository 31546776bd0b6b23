"""Inverse models of a piezo."""
