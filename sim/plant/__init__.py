"""The nominal plant, sampled exactly.

Equation of motion, exact sampling and control loop.
"""
