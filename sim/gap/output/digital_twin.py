"""The digital twin: a robot file with the effects that a diagnosis fitted."""

from collections.abc import Sequence
from dataclasses import fields, replace
from os import PathLike, fspath
from pathlib import Path

from rotemina.sim.errors import FileWriteError, GapError
from rotemina.sim.files import replace_file
from rotemina.sim.messages import message
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.robot_files import (
    format_robot,
    list_shipped_robots,
    load_robot,
    read_robot_file,
    sort_by_axis,
    with_effects,
)


def make_twin_text(
    robot: Robot, effects: Sequence[AxisEffect], source: str | PathLike[str] | None = None
) -> str:
    """Return the text of a robot file, with the fitted effects appended to its own.

    Parameters
    ----------
    robot : Robot
        The diagnosed robot.
    effects : sequence of AxisEffect
    source : name of a shipped robot or path of a robot file, optional
        File whose text is kept, including its comments. By default, it is the shipped file that
        describes ``robot``; if there is none, a new text is written.

    Raises
    ------
    GapError
        If ``source`` does not describe the diagnosed robot.
    RobotFileError, EffectError
        If the file cannot be read or an effect cannot be added to it.
    """
    if source is None:
        source = next(
            (name for name in list_shipped_robots() if _is_same(load_robot(name), robot)), None
        )
        if source is None:
            return with_effects(format_robot(robot), effects, robot.name)
    name = fspath(source)
    # A string may also be the name of a shipped robot.
    source = source if isinstance(source, str) else Path(source)
    source_robot = load_robot(source)
    if not _is_same(source_robot, robot):
        raise GapError(
            "{name}: this file does not describe the diagnosed robot {robot_name} "
            "(differences: {differences}); diagnose again with this file, or omit it to write "
            "the diagnosed robot",
            name=name,
            robot_name=repr(robot.name),
            differences=_describe_differences(source_robot, robot),
        )
    return with_effects(read_robot_file(source), effects, name)


def write_twin(text: str, path: str | PathLike[str]) -> None:
    """Write the text of a twin to a new file atomically.

    Raises
    ------
    FileWriteError
        If the file exists already or cannot be written.
    """
    if Path(path).exists():
        raise FileWriteError(
            message("gap", "{fspath} already exists; name another file").fill(fspath=fspath(path))
        )
    with replace_file(path) as file:
        file.write(text.encode("utf-8"))


def _is_same(first: Robot, second: Robot) -> bool:
    """Return whether two robots are equal. The order of effects matters only within an axis."""
    return not _find_different_fields(first, second)


def _find_different_fields(first: Robot, second: Robot) -> list[str]:
    robots = [
        replace(robot, effects=sort_by_axis(robot, robot.effects)) for robot in (first, second)
    ]
    names = [field.name for field in fields(Robot)]
    return [name for name in names if getattr(robots[0], name) != getattr(robots[1], name)]


def _describe_differences(first: Robot, second: Robot) -> str:
    names = _find_different_fields(first, second)
    if "axes" in names and list(first.axes) == list(second.axes):
        axes = [axis for axis in first.axes if first.axes[axis] != second.axes[axis]]
        names[names.index("axes")] = f"axis {', '.join(axes)}"
    return ", ".join(names)
