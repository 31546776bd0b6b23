"""Options that several subcommands share."""

import argparse

from rotemina.sim.robot.file import load_robot, shipped_robots
from rotemina.sim.robot.model import Robot

COLUMNS_HELP = "name the columns of a file without a header, e.g. 't [s], x [mm], thx [urad]'"


def add_robot(parser: argparse.ArgumentParser, *, default: str = argparse.SUPPRESS) -> None:
    """Add ``--robot``; a subcommand leaves what stands before it unless it is given again."""
    parser.add_argument(
        "--robot",
        default=default,
        metavar="NAME_OR_FILE",
        help=f"a robot file, or a shipped robot: {', '.join(shipped_robots())} (default: rotemina)",
    )


def add_columns(parser: argparse.ArgumentParser) -> None:
    """Add ``--columns``."""
    parser.add_argument("--columns", metavar="'t [s], …'", help=COLUMNS_HELP)


def robot_of(options: argparse.Namespace) -> Robot:
    """Load the robot that ``--robot`` names."""
    return load_robot(options.robot)
