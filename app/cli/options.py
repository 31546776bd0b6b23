"""Options and output shared by several subcommands."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from rotemina.sim.effects.attachment import attached_effects
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.errors import InputError
from rotemina.sim.excitation.quantity import Stated, parse_amount
from rotemina.sim.messages import AxisName, Listed, Message, message
from rotemina.sim.quantities import scale_in
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.robot.file import load_robot, shipped_robots
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import check_commands_of_model, with_limits

#: What to do where a record is of another machine.
ANOTHER_MODEL = message("cli", "choose its model with --robot")

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


def tell_model(options: argparse.Namespace, name: str, source: object = None) -> None:
    """Name the model on stderr, ahead of everything else that is written there.

    ``source`` is where it comes from; None: from ``--robot``.
    """
    if source is None and options.robot in shipped_robots():
        said = message("cli", "Model: {robot} (built in); choose another with --robot")
        text = options.wording.of(said.fill(robot=name))
    else:
        said = message("cli", "Model: {robot} ({file})")
        file = options.robot if source is None else source
        text = options.wording.of(said.fill(robot=name, file=str(file)))
    print(text, file=sys.stderr, flush=True)


def records_of_model(
    options: argparse.Namespace, robot: Robot, paths: Sequence[Path]
) -> list[Record]:
    """Read records that are compared with a model.

    Raises
    ------
    InputError
        If a file cannot be read, or is a record of another machine.
    """
    records = [read_record(path, columns=options.columns, robot=robot) for path in paths]
    for path, record in zip(paths, records, strict=True):
        check_commands_of_model(robot, record, path, ANOTHER_MODEL)
    return records


def add_max_speed(parser: argparse.ArgumentParser) -> None:
    """Add ``--max-speed``."""
    parser.add_argument(
        "--max-speed",
        metavar="x=10mm/s,1mrad/s",
        help="greatest speed of an axis, or of all axes of this unit; needed for axes whose speed "
        "the robot file does not limit",
    )


def with_max_speeds(options: argparse.Namespace, robot: Robot, axes: Sequence[str]) -> Robot:
    """Return the robot with the speed limits of ``--max-speed``, where they are stricter.

    ``axes`` are those that move.

    Raises
    ------
    InputError
        If a speed is none, has the wrong unit, or belongs to no axis that moves.
    """
    if options.max_speed is None:
        return robot
    units = {axis: f"{robot.unit(axis) or 'm'}/s" for axis in axes}
    of_units: dict[str, float] = {}
    of_axes: dict[str, float] = {}
    for part in filter(None, map(str.strip, options.max_speed.split(","))):
        axis, equals, text = part.rpartition("=")
        axis = axis.strip()
        if equals and axis not in units:
            raise InputError(
                message(
                    "cli", "--max-speed {part}: axis {axis} does not move; use one of {axes}"
                ).fill(part=part, axis=repr(axis), axes=", ".join(units))
            )
        speed = _speed(part, text)
        if speed.unit not in ([units[axis]] if equals else units.values()):
            expected = units[axis] if equals else " / ".join(dict.fromkeys(units.values()))
            raise InputError(
                message("cli", "--max-speed {part}: is in {unit}, not in {expected}").fill(
                    part=part, unit=speed.unit, expected=expected
                )
            )
        into, key = (of_axes, axis) if equals else (of_units, speed.unit)
        if key in into:
            raise InputError(
                message("cli", "--max-speed {text}: has two values for {what}").fill(
                    text=options.max_speed, what=key
                )
            )
        into[key] = speed.value
    speeds = {axis: of_units[unit] for axis, unit in units.items() if unit in of_units}
    return with_limits(robot, speeds | of_axes)


def _speed(part: str, text: str) -> Stated:
    try:
        speed = parse_amount(text)
    except InputError as error:
        raise InputError(
            message("cli", "--max-speed {part}: {error}").fill(part=part, error=str(error))
        ) from error
    if isinstance(speed, Stated) and speed.value > 0.0:
        return speed
    raise InputError(
        message("cli", "--max-speed {part}: must be a speed above 0, such as 10mm/s").fill(
            part=part
        )
    )


def check_speed_limits(options: argparse.Namespace, robot: Robot, axes: Sequence[str]) -> None:
    """Refuse to move axes whose speed nothing limits.

    Raises
    ------
    InputError
        With the axes, and what to add.
    """
    missing = [axis for axis in axes if robot.axes[axis].max_speed is None]
    if not missing:
        return
    examples = ("1mrad/s" if robot.unit(axis) == "rad" else "1mm/s" for axis in missing)
    raise InputError(
        message(
            "cli",
            "the robot file states no speed limit (max_speed) of {axes}; give the greatest speed "
            "that the machine may move at, such as --max-speed {example}",
        ).fill(
            axes=Listed(tuple(map(AxisName, missing))),
            example=",".join(
                f"{axis}={speed}" for axis, speed in zip(missing, examples, strict=True)
            ),
        )
    )


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
