"""The holding plate in 3-D.

Stress, deformation and modes over the range of motion.
"""
