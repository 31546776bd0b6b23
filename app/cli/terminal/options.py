"""Options and output shared by several subcommands."""

import argparse
import os
import sys
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from rotemina.app.errors import CommandError
from rotemina.sim.effects import (
    attach_effects,
)
from rotemina.sim.errors import (
    EffectError,
    InputError,
)
from rotemina.sim.excitation import StatedAmount, parse_amount
from rotemina.sim.messages import AxisName, FieldList, Message, message
from rotemina.sim.records import Record, read_record
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import list_shipped_robots, load_robot
from rotemina.sim.trajectory import check_commands_fit_model, with_limits
from rotemina.sim.units import make_scale

#: Advice if a record does not fit the model of the machine.
CHOOSE_MODEL_ADVICE = message("cli", "choose its model with --robot")

COLUMNS_HELP = "name the columns of a file without a header, e.g. 't [s], x [mm], thx [urad]'"


def add_robot(parser: argparse.ArgumentParser, *, default: str = argparse.SUPPRESS) -> None:
    """Add ``--robot``.

    Without ``default``, the subcommand's option does not replace a value that was given before the
    name of the subcommand.
    """
    parser.add_argument(
        "--robot",
        default=default,
        metavar="NAME_OR_FILE",
        help=f"a robot file, or a shipped robot: {', '.join(list_shipped_robots())} "
        "(default: rotemina)",
    )


def add_columns(parser: argparse.ArgumentParser) -> None:
    """Add ``--columns``."""
    parser.add_argument("--columns", metavar="'t [s], …'", help=COLUMNS_HELP)


def load_selected_robot(options: argparse.Namespace) -> Robot:
    """Load the robot of ``--robot``."""
    return load_robot(options.robot)


def print_model(options: argparse.Namespace, name: str, source: object = None) -> None:
    """Print the name of the model on stderr, before other messages.

    ``source`` is the file that contains the model; by default the value of ``--robot``.
    """
    if source is None and options.robot in list_shipped_robots():
        template = message("cli", "Model: {robot} (built in); choose another with --robot")
        text = options.wording.format_message(template.fill(robot=name))
    else:
        template = message("cli", "Model: {robot} ({file})")
        file = options.robot if source is None else source
        text = options.wording.format_message(template.fill(robot=name, file=str(file)))
    print(text, file=sys.stderr, flush=True)


def read_records_of_model(
    options: argparse.Namespace, robot: Robot, paths: Sequence[Path]
) -> list[Record]:
    """Read records or trajectories, and check that their commands fit a model.

    Raises
    ------
    InputError
        If a file cannot be read, or its commands do not fit the model.
    """
    records = [read_record(path, columns=options.columns, robot=robot) for path in paths]
    for path, record in zip(paths, records, strict=True):
        check_commands_fit_model(robot, record, path, CHOOSE_MODEL_ADVICE)
    return records


def check_output_files(outputs: Iterable[Path | None], inputs: Iterable[Path | None]) -> None:
    """Refuse output files that cannot be created, or would overwrite an input or each other.

    Call this before any long work. None stands for an option that is not given.

    Raises
    ------
    InputError
        If the folder of an output does not exist or cannot be written, an output is a folder, or
        it is the same file as another one, also through a link.
    """
    used_paths = [path for path in inputs if path is not None]
    for output in filter(None, outputs):
        if not output.parent.is_dir():
            raise CommandError(
                "{output} cannot be written: there is no folder {parent}; create it, or "
                "choose another",
                output=output,
                parent=output.parent,
            )
        if output.is_dir():
            raise CommandError("{output} is a folder; name a file in it", output=output)
        if not os.access(output.parent, os.W_OK):
            raise CommandError(
                "{output} cannot be written: no permission to create files in {parent}; choose "
                "another folder",
                output=output,
                parent=output.parent,
            )
        if any(is_same_file(output, path) for path in used_paths):
            raise CommandError(
                "{output} is named twice; give each file its own name", output=output
            )
        used_paths.append(output)


def is_same_file(path: Path, other: Path) -> bool:
    """Return whether two paths lead to the same file, which need not exist yet."""
    if os.path.realpath(path) == os.path.realpath(other):
        return True
    return path.exists() and other.exists() and path.samefile(other)


def find_robot_file(name_or_file: str | None) -> Path | None:
    """Return the path of a robot file, or None if it is a shipped robot or not given."""
    if name_or_file is None or name_or_file in list_shipped_robots():
        return None
    return Path(name_or_file)


def find_json_file(json_option: str | None) -> Path | None:
    """Return the path of ``--json``, or None if it is not given or prints the JSON."""
    return Path(json_option) if json_option not in (None, "-") else None


def add_max_speed(parser: argparse.ArgumentParser) -> None:
    """Add ``--max-speed``."""
    parser.add_argument(
        "--max-speed",
        metavar="x=10mm/s,1mrad/s",
        help="maximum speed of an axis, or of all axes with this unit; needed for axes whose speed "
        "the robot file does not limit",
    )


def with_max_speeds(options: argparse.Namespace, robot: Robot, axes: Sequence[str]) -> Robot:
    """Return the robot with the speed limits of ``--max-speed`` where they are stricter.

    ``axes`` are the axes that move.

    Raises
    ------
    InputError
        If a value is not a speed, has the wrong unit, or belongs to an axis that does not move.
    """
    if options.max_speed is None:
        return robot
    units = {axis: f"{robot.unit(axis) or 'm'}/s" for axis in axes}
    speed_by_unit: dict[str, float] = {}
    speed_by_axis: dict[str, float] = {}
    for part in filter(None, map(str.strip, options.max_speed.split(","))):
        axis, equals, text = part.rpartition("=")
        axis = axis.strip()
        if equals and axis not in units:
            raise CommandError(
                "--max-speed {part}: axis {axis} does not move; use one of {axes}",
                part=part,
                axis=repr(axis),
                axes=", ".join(units),
            )
        speed = _parse_speed(part, text)
        if speed.unit not in ([units[axis]] if equals else units.values()):
            expected = units[axis] if equals else " / ".join(dict.fromkeys(units.values()))
            raise CommandError(
                "--max-speed {part}: is in {unit}, not in {expected}",
                part=part,
                unit=speed.unit,
                expected=expected,
            )
        limits, key = (speed_by_axis, axis) if equals else (speed_by_unit, speed.unit)
        if key in limits:
            raise CommandError(
                "--max-speed {text}: has two values for {what}", text=options.max_speed, what=key
            )
        limits[key] = speed.value
    speeds = {axis: speed_by_unit[unit] for axis, unit in units.items() if unit in speed_by_unit}
    return with_limits(robot, speeds | speed_by_axis)


def _parse_speed(part: str, text: str) -> StatedAmount:
    try:
        speed = parse_amount(text)
    except InputError as error:
        raise CommandError("--max-speed {part}: {error}", part=part, error=str(error)) from error
    if isinstance(speed, StatedAmount) and speed.value > 0.0:
        return speed
    raise CommandError("--max-speed {part}: must be a speed above 0, such as 10mm/s", part=part)


def require_speed_limits(options: argparse.Namespace, robot: Robot, axes: Sequence[str]) -> None:
    """Check that the robot has a speed limit for each axis that is going to move.

    Raises
    ------
    InputError
        If an axis has no speed limit; the message names the axes and the option to add.
    """
    axes_without_limit = [axis for axis in axes if robot.axes[axis].max_speed is None]
    if not axes_without_limit:
        return
    examples = ("1mrad/s" if robot.unit(axis) == "rad" else "1mm/s" for axis in axes_without_limit)
    raise CommandError(
        "the robot file states no speed limit (max_speed) of {axes}; give the greatest speed "
        "that the machine may move at, such as --max-speed {example}",
        axes=FieldList(tuple(map(AxisName, axes_without_limit))),
        example=",".join(
            f"{axis}={speed}" for axis, speed in zip(axes_without_limit, examples, strict=True)
        ),
    )


def load_robot_with_effects(options: argparse.Namespace) -> Robot:
    """Load the robot of ``--robot``, with the effects of the file ``--effects`` if that is given.

    Raises
    ------
    InputError
        If an effect does not fit the robot.
    """
    robot = load_selected_robot(options)
    if options.effects is None:
        return robot
    robot = replace(robot, effects=load_robot(options.effects).effects)
    try:
        attach_effects(robot)
    except EffectError as error:
        raise CommandError(
            "{effects}: on robot {name}: {error}",
            effects=options.effects,
            name=repr(robot.name),
            error=str(error),
        ) from error
    return robot


def print_message(options: argparse.Namespace, text: Message) -> None:
    """Print a message in the language of the command line."""
    print(options.wording.format_message(text), flush=True)


def print_written_file(
    options: argparse.Namespace, output: Path, rows: int, duration_s: float
) -> None:
    """Print the name of a written file, its rows and its duration."""
    text = message("cli", "{output}: {rows} rows, {duration}")
    duration = make_scale("s", digits=6).format_with_unit(duration_s)
    print_message(options, text.fill(output=output, rows=rows, duration=duration))
