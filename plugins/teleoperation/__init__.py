"""Teleoperation, with an on-screen pad."""
