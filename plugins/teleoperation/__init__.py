"""Teleoperation panel: who drives, in which mode and scale, and a pad on the screen."""
