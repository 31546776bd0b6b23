"""The digital twin brought up to date: a robot file with the effects that a diagnosis fitted."""

from collections.abc import Sequence
from dataclasses import fields, replace
from os import PathLike, fspath
from pathlib import Path

from rotemina.sim.gap.errors import GapError
from rotemina.sim.messages import message
from rotemina.sim.robot.file import load_robot, robot_file_text, shipped_robots
from rotemina.sim.robot.model import AxisEffect, Robot
from rotemina.sim.robot.writing import by_axis, robot_text, with_effects
from rotemina.sim.whole_files import FileWriteError, replaced


def twin_text(
    robot: Robot, effects: Sequence[AxisEffect], source: str | PathLike[str] | None = None
) -> str:
    """Return the text of a robot file with fitted effects behind those that it has.

    Parameters
    ----------
    robot : Robot
        Which was diagnosed.
    effects : sequence of AxisEffect
    source : name of a shipped robot or path of a robot file, optional
        Whose text, comments too, is kept. Without, that of the shipped robot which is the same,
        or else a new text.

    Raises
    ------
    GapError
        If ``source`` describes another robot than the one that was diagnosed.
    RobotFileError, EffectError
        If the file cannot be read or an effect cannot be added to it.
    """
    if source is None:
        source = next((name for name in shipped_robots() if _same(load_robot(name), robot)), None)
    if source is None:
        return with_effects(robot_text(robot), effects, robot.name)
    name = fspath(source)
    source = source if isinstance(source, str) else Path(source)
    found = load_robot(source)
    if not _same(found, robot):
        raise GapError(
            message(
                "gap",
                "{name}: it describes another robot than the one that was diagnosed, "
                "{robot_name}: they differ in {differences}; diagnose again with this file, or "
                "leave it out to write the diagnosed one",
            ).fill(name=name, robot_name=repr(robot.name), differences=_differences(found, robot))
        )
    return with_effects(robot_file_text(source), effects, name)


def write_twin(text: str, path: str | PathLike[str]) -> None:
    """Write the text of a twin as a new file, whole or not at all.

    Raises
    ------
    FileWriteError
        If there is a file already, or none can be written.
    """
    if Path(path).exists():
        raise FileWriteError(
            message("gap", "{fspath} already exists; name another file").fill(fspath=fspath(path))
        )
    with replaced(path) as file:
        file.write(text.encode("utf-8"))


def _same(one: Robot, other: Robot) -> bool:
    """Whether two robots are the same, but for the order of effects between axes."""
    return not _differing(one, other)


def _differing(one: Robot, other: Robot) -> list[str]:
    ordered = [replace(robot, effects=by_axis(robot, robot.effects)) for robot in (one, other)]
    names = [field.name for field in fields(Robot)]
    return [name for name in names if getattr(ordered[0], name) != getattr(ordered[1], name)]


def _differences(one: Robot, other: Robot) -> str:
    """Name what differs; of axes, which."""
    names = _differing(one, other)
    if "axes" in names and list(one.axes) == list(other.axes):
        differing = [axis for axis in one.axes if one.axes[axis] != other.axes[axis]]
        names[names.index("axes")] = f"axis {', '.join(differing)}"
    return ", ".join(names)
