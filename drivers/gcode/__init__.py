"""Stages driven by G-code over a serial line, as GRBL does, and an emulated one."""
