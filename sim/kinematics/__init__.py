"""Kinematics of the hybrid chain: micro tables that carry a tilting, extending nano stage."""
