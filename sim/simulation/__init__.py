"""Simulated records: a robot with its effects, its noise and its chance, driven by commands."""
