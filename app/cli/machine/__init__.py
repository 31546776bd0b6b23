"""Subcommands for machines: virtual boards and stages, calibration, the plate, and ``doctor``.

Each module is one subcommand. ``board_ports`` opens the ports of virtual boards and stages. Only
``app/cli`` imports from here.
"""
