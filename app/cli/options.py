"""Options that several subcommands share."""

import argparse
from dataclasses import replace

from rotemina.sim.effects.attachment import attached_effects
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
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


def robot_with_effects(options: argparse.Namespace) -> Robot:
    """Load the robot that ``--robot`` names, with the effects of ``--effects``.

    Raises
    ------
    InputError
        If an effect does not fit the robot.
    """
    robot = robot_of(options)
    if options.effects is None:
        return robot
    robot = replace(robot, effects=load_robot(options.effects).effects)
    try:
        attached_effects(robot)
    except EffectError as error:
        raise InputError(
            message("cli", "{effects}: on robot {name}: {error}").fill(
                effects=options.effects, name=repr(robot.name), error=str(error)
            )
        ) from error
    return robot
