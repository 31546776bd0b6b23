"""Robot files: strict reading of a machine description in TOML.

Every error names the file, the key, the value and the bound. A file is data: nothing in it is
ever executed.
"""

from collections.abc import Mapping
from dataclasses import field, replace
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from rotemina.sim.effects.attachment import Attached, parse_effect
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.input_files import parse_toml, read_text
from rotemina.sim.messages import marked, message
from rotemina.sim.robot.consistency import Problem, find_problem
from rotemina.sim.robot.errors import RobotFileError
from rotemina.sim.robot.model import (
    Axis,
    Coupling,
    KeepOut,
    Microscope,
    Reference,
    Robot,
    Tool,
)
from rotemina.sim.robot.numbers import FORBID_UNKNOWN, Positive
from rotemina.sim.robot.plate import Plate
from rotemina.sim.robot.schema_errors import describe

MAX_BYTES = 4_000_000
SHIPPED = "rotemina.resources.robots"

# Joint names of the RoTeMiNa chain whose quantity is known without a `unit` key.
CONVENTIONAL_UNITS: Mapping[str, Literal["m", "rad"]] = {
    "x": "m",
    "y": "m",
    "z": "m",
    "zn": "m",
    "thx": "rad",
    "thy": "rad",
}


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class _RobotTable:
    name: str
    axes: tuple[str, ...]
    stages: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    pin_length: Positive | None = None
    piezo_lever_arm: Positive | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class _RobotFile:
    robot: _RobotTable
    axis: dict[str, Annotated[Axis, Field(discriminator="kind")]]
    coupling: tuple[Coupling, ...] = ()
    reference: Reference = field(default_factory=Reference)
    tool: Tool = field(default_factory=Tool)
    microscope: Microscope = field(default_factory=Microscope)
    keep_out: KeepOut = field(default_factory=KeepOut)
    plate: Plate = field(default_factory=Plate)


_SCHEMA = TypeAdapter(_RobotFile)


def shipped_robots() -> tuple[str, ...]:
    """Return the names of the robots that the program carries, sorted."""
    folder = resources.files(SHIPPED)
    return tuple(sorted(item.name[:-5] for item in folder.iterdir() if item.name.endswith(".toml")))


def nominal_robots() -> tuple[str, ...]:
    """Return the names of the shipped robots that are described without any effect, sorted."""
    return tuple(name for name in shipped_robots() if not _effects_of(name))


def load_robot(name_or_file: str | Path) -> Robot:
    """Load a shipped robot by name, or a robot file by path.

    Raises
    ------
    RobotFileError
        If there is no such robot, the file cannot be read, or it is not a valid description.
    """
    shipped = _is_shipped(name_or_file)
    source = f"{name_or_file}.toml" if shipped else str(name_or_file)
    return parse_robot(robot_file_text(name_or_file), source)


def robot_file_text(name_or_file: str | Path) -> str:
    """Return the text of a robot file; parameters and errors as of :func:`load_robot`."""
    if _is_shipped(name_or_file):
        return resources.files(SHIPPED).joinpath(f"{name_or_file}.toml").read_text("utf-8")
    return _read(Path(name_or_file))


def parse_robot(text: str, source: str = "robot file") -> Robot:
    """Build a robot from the text of a robot file; ``source`` names it in errors.

    Raises
    ------
    RobotFileError
        With file, key, value and bound.
    """
    return _build(parse_toml(text, source, RobotFileError), source)


def _build(table: dict[str, Any], source: str) -> Robot:
    plain, effect_tables = _apart(table, source)
    try:
        parsed = _SCHEMA.validate_python(plain)
    except ValidationError as error:
        raise RobotFileError(
            message("engine", "{source}: {describe}").fill(source=source, describe=describe(error))
        ) from error
    names = parsed.robot.axes
    problem = _axis_list_problem(names, parsed.axis)
    if problem is None:
        robot = _robot(parsed)
        problem = find_problem(robot)
    if problem is not None:
        raise RobotFileError(
            message("engine", "{source}: {problem}").fill(source=source, problem=str(problem))
        )
    return _with_effects(robot, effect_tables, source)


def _apart(
    table: dict[str, Any], source: str
) -> tuple[dict[str, Any], list[tuple[str, dict[str, Any]]]]:
    """Return the description without its effects, and the effects by axis."""
    axes = table.get("axis")
    if not isinstance(axes, dict):
        return table, []
    plain: dict[str, Any] = {}
    effects: list[tuple[str, dict[str, Any]]] = []
    for name, axis in axes.items():
        if not isinstance(axis, dict) or "effect" not in axis:
            plain[name] = axis
            continue
        plain[name] = {key: value for key, value in axis.items() if key != "effect"}
        tables = axis["effect"]
        if not isinstance(tables, list) or not all(isinstance(t, dict) for t in tables):
            raise RobotFileError(
                message(
                    "engine",
                    "{source}: axis.{name}.effect: must be tables, each headed "
                    "[[axis.{name}.effect]]",
                ).fill(source=source, name=name)
            )
        effects += [(name, one) for one in tables]
    return {**table, "axis": plain}, effects


def _with_effects(robot: Robot, tables: list[tuple[str, dict[str, Any]]], source: str) -> Robot:
    if not tables:
        return robot
    try:
        effects = tuple(parse_effect(axis, table) for axis, table in tables)
        robot = replace(robot, effects=effects)
        for effect in effects:
            Attached.of(robot, effect)
    except EffectError as error:
        raise RobotFileError(
            message("engine", "{source}: {error}").fill(source=source, error=str(error))
        ) from error
    return robot


def _axis_list_problem(names: tuple[str, ...], tables: Mapping[str, Axis]) -> Problem | None:
    if not names:
        return Problem("robot.axes", names, marked("engine", "names at least one axis"))
    if len(set(names)) != len(names):
        return Problem("robot.axes", list(names), marked("engine", "names each axis once"))
    for name in names:
        if name not in tables:
            return Problem(
                "robot.axes", name, message("engine", "needs a table [axis.{name}]").fill(name=name)
            )
    for name in tables:
        if name not in names:
            return Problem(
                f"axis.{name}",
                name,
                message("engine", "must be listed in robot.axes {names}").fill(
                    names=str(list(names))
                ),
            )
    return None


def _robot(parsed: _RobotFile) -> Robot:
    return Robot(
        name=parsed.robot.name,
        axes={name: _with_unit(name, parsed.axis[name]) for name in parsed.robot.axes},
        stages=parsed.robot.stages,
        couplings=parsed.coupling,
        pin_length=parsed.robot.pin_length,
        piezo_lever_arm=parsed.robot.piezo_lever_arm,
        reference=parsed.reference,
        tool=parsed.tool,
        microscope=parsed.microscope,
        keep_out=parsed.keep_out,
        plate=parsed.plate,
    )


def _with_unit(name: str, axis: Axis) -> Axis:
    unit = CONVENTIONAL_UNITS.get(name)
    if axis.unit is not None or unit is None:
        return axis
    return replace(axis, unit=unit)


def _effects_of(name: str) -> list[tuple[str, dict[str, Any]]]:
    """Return the effects in a shipped robot's file, as tables by axis."""
    source = f"{name}.toml"
    return _apart(parse_toml(robot_file_text(name), source, RobotFileError), source)[1]


def _is_shipped(name_or_file: str | Path) -> bool:
    return isinstance(name_or_file, str) and name_or_file in shipped_robots()


def _read(path: Path) -> str:
    try:
        return read_text(path, RobotFileError, MAX_BYTES)
    except RobotFileError as error:
        if not isinstance(error.__cause__, FileNotFoundError):
            raise
        known = ", ".join(shipped_robots())
        raise RobotFileError(
            message(
                "engine",
                "{path}: no such robot file, and no shipped robot of that name (shipped: {known})",
            ).fill(path=path, known=known)
        ) from error
