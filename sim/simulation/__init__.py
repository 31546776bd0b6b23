"""Simulated records with effects and noise."""
