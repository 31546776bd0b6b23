"""Feedback of an axis: a sampled controller, the stability of its loop, the loop simulated."""
