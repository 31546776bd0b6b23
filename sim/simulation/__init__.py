"""Simulated records with effects and noise.

Commands drive a robot with its effects, noise and chance.
"""
