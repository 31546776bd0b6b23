"""Kinematics of the hybrid chain.

Micro tables carry a tilting, extending nano stage.
"""
