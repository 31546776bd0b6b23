"""Stages that are driven by G-code over a serial line, as GRBL does, and one that is emulated."""
