"""Controllers and their loops' stability.

A sampled controller, the stability of its loop, and the simulated loop.
"""
