"""Teleoperation: from the readings of an input device to the motion of axes."""
