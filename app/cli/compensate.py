"""``rotemina compensate``: inverse models of a piezo's hysteresis."""

import argparse

from rotemina.app.cli import compensate_apply, compensate_check, compensate_train


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand and its verbs."""
    parser = commands.add_parser(
        "compensate",
        help="train inverse models of hysteresis, check them, and apply them to trajectories",
        description="Learn which commands bring a piezo axis to the desired positions: an ANFIS, "
        "the modified and the classical Prandtl–Ishlinskii inverse and a straight "
        "line, compared with each other.",
    )
    verbs = parser.add_subparsers(title="subcommands", metavar="", required=True)
    compensate_train.add_parser(verbs)
    compensate_check.add_parser(verbs)
    compensate_apply.add_parser(verbs)
