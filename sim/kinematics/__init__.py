"""Kinematics of the hybrid chain."""
