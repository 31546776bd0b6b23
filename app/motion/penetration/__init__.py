"""Automatic cell penetration: approach, contact, thrust, hold, retract."""
