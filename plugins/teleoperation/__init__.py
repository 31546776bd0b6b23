"""Teleoperation panel: control, mode, scale, and an on-screen pad."""
