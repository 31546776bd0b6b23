"""The command `rotemina` and its subcommands."""
