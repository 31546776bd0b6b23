"""Options and output shared by several subcommands."""

import argparse
from dataclasses import replace
from pathlib import Path

from rotemina.sim.effects.attachment import attached_effects
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.errors import InputError
from rotemina.sim.messages import Message, message
from rotemina.sim.quantities import scale_in
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


def tell(options: argparse.Namespace, said: Message) -> None:
    """Print a message in the language of the command line."""
    print(options.wording.of(said), flush=True)


def tell_written(options: argparse.Namespace, output: Path, rows: int, duration_s: float) -> None:
    """Print which file was written, and how long it is."""
    said = message("cli", "{output}: {rows} rows, {duration}")
    duration = scale_in("s", digits=6).text(duration_s)
    tell(options, said.fill(output=output, rows=rows, duration=duration))
