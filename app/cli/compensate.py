"""``rotemina compensate``: inverse models of a piezo's hysteresis."""

import argparse

from rotemina.app.cli import compensate_apply, compensate_check, compensate_train


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand and its verbs."""
    parser = commands.add_parser(
        "compensate",
        help="learn inverse models of hysteresis, check them, and apply them to trajectories",
        description="Learn what a piezo must be told so that it comes where it shall: an ANFIS, "
        "the modified and the classical Prandtl–Ishlinskii inverse and a straight line, judged "
        "side by side.",
    )
    verbs = parser.add_subparsers(title="verbs", metavar="", required=True)
    compensate_train.add_parser(verbs)
    compensate_check.add_parser(verbs)
    compensate_apply.add_parser(verbs)
