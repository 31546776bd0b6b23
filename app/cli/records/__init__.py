"""Subcommands for records and trajectories: simulate, play, compare, convert, excite, recover.

Each module is one subcommand; ``recording`` has those for recorded sessions. Only ``app/cli``
imports from here.
"""
