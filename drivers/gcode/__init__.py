"""GRBL stages by G-code, and an emulated one."""
