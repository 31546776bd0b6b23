"""Subcommands for the sim-to-real gap: diagnosis, benchmark and blind test.

Each module is one subcommand. The work is done in ``sim/gap``, ``app/bench`` and ``app/blind``.
Only ``app/cli`` imports from here.
"""
