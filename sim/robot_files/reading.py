"""Robot files: strict reading of a machine description in TOML.

Every error names the file, the key, the value and the bound. A file is data: nothing in it is
ever executed.
"""

from collections.abc import Mapping
from dataclasses import field, replace
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.effects import AttachedEffect, parse_effect
from rotemina.sim.errors import EffectError, RobotFileError
from rotemina.sim.files import parse_toml, read_text
from rotemina.sim.messages import marked, message
from rotemina.sim.robot import (
    FORBID_UNKNOWN,
    Axis,
    AxisCoupling,
    KeepOut,
    Plate,
    Positive,
    ReferenceSensor,
    Robot,
    RobotMicroscope,
    RobotTool,
)
from rotemina.sim.robot_files.consistency import RobotProblem, find_problem
from rotemina.sim.robot_files.schema_errors import describe_error

MAX_FILE_BYTES = 4_000_000
SHIPPED_ROBOTS_PACKAGE = "rotemina.resources.robots"

# Units of the joints of the RoTeMiNa chain, which need no `unit` key.
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
    coupling: tuple[AxisCoupling, ...] = ()
    reference: ReferenceSensor = field(default_factory=ReferenceSensor)
    tool: RobotTool = field(default_factory=RobotTool)
    microscope: RobotMicroscope = field(default_factory=RobotMicroscope)
    keep_out: KeepOut = field(default_factory=KeepOut)
    plate: Plate = field(default_factory=Plate)


_SCHEMA = TypeAdapter(_RobotFile)
# Name of the axis and content of each [[axis.NAME.effect]] table.
_EffectTables = list[tuple[str, dict[str, Any]]]


def list_shipped_robots() -> tuple[str, ...]:
    """Return the sorted names of the robots that are shipped with the program."""
    folder = resources.files(SHIPPED_ROBOTS_PACKAGE)
    return tuple(sorted(item.name[:-5] for item in folder.iterdir() if item.name.endswith(".toml")))


def list_nominal_robots() -> tuple[str, ...]:
    """Return the sorted names of the shipped robots that have no effects."""
    return tuple(name for name in list_shipped_robots() if not _read_effects(name))


def load_robot(name_or_file: str | Path) -> Robot:
    """Load a shipped robot by name, or a robot file by path.

    Raises
    ------
    RobotFileError
        If there is no such robot, the file cannot be read, or it is not a valid description.
    """
    shipped = _is_shipped(name_or_file)
    source = f"{name_or_file}.toml" if shipped else str(name_or_file)
    return parse_robot(read_robot_file(name_or_file), source)


def read_robot_file(name_or_file: str | Path) -> str:
    """Return the text of a robot file; parameters and errors as in :func:`load_robot`."""
    if _is_shipped(name_or_file):
        return (
            resources.files(SHIPPED_ROBOTS_PACKAGE)
            .joinpath(f"{name_or_file}.toml")
            .read_text("utf-8")
        )
    return _read_robot_text(Path(name_or_file))


def parse_robot(text: str, source: str = "robot file") -> Robot:
    """Build a robot from the text of a robot file; ``source`` names the file in errors.

    Raises
    ------
    RobotFileError
        If the text is not a valid description. The message names file, key, value and bound.
    """
    return _build_robot(parse_toml(text, source, RobotFileError), source)


def _build_robot(table: dict[str, Any], source: str) -> Robot:
    table_without_effects, effect_tables = _split_effects(table, source)
    try:
        parsed = _SCHEMA.validate_python(table_without_effects)
    except ValidationError as error:
        raise RobotFileError(
            "{source}: {describe}", source=source, describe=describe_error(error)
        ) from error
    names = parsed.robot.axes
    problem = _find_axis_list_problem(names, parsed.axis)
    if problem is None:
        robot = _make_robot(parsed)
        problem = find_problem(robot)
    if problem is not None:
        raise RobotFileError("{source}: {problem}", source=source, problem=str(problem))
    return _with_effects(robot, effect_tables, source)


def _split_effects(table: dict[str, Any], source: str) -> tuple[dict[str, Any], _EffectTables]:
    axes = table.get("axis")
    if not isinstance(axes, dict):
        return table, []
    axes_without_effects: dict[str, Any] = {}
    effects: _EffectTables = []
    for name, axis in axes.items():
        if not isinstance(axis, dict) or "effect" not in axis:
            axes_without_effects[name] = axis
            continue
        axes_without_effects[name] = {key: value for key, value in axis.items() if key != "effect"}
        tables = axis["effect"]
        if not isinstance(tables, list) or not all(isinstance(t, dict) for t in tables):
            raise RobotFileError(
                "{source}: axis.{name}.effect: must be tables, each headed [[axis.{name}.effect]]",
                source=source,
                name=name,
            )
        effects += [(name, effect) for effect in tables]
    return {**table, "axis": axes_without_effects}, effects


def _with_effects(robot: Robot, tables: _EffectTables, source: str) -> Robot:
    if not tables:
        return robot
    try:
        effects = tuple(parse_effect(axis, table) for axis, table in tables)
        robot = replace(robot, effects=effects)
        for effect in effects:
            AttachedEffect.of(robot, effect)
    except EffectError as error:
        raise RobotFileError("{source}: {error}", source=source, error=str(error)) from error
    return robot


def _find_axis_list_problem(
    names: tuple[str, ...], tables: Mapping[str, Axis]
) -> RobotProblem | None:
    if not names:
        return RobotProblem("robot.axes", names, marked("engine", "must name at least one axis"))
    if len(set(names)) != len(names):
        return RobotProblem("robot.axes", list(names), marked("engine", "must name each axis once"))
    for name in names:
        if name not in tables:
            return RobotProblem(
                "robot.axes", name, message("engine", "needs a table [axis.{name}]").fill(name=name)
            )
    for name in tables:
        if name not in names:
            return RobotProblem(
                f"axis.{name}",
                name,
                message("engine", "must be listed in robot.axes {names}").fill(
                    names=str(list(names))
                ),
            )
    return None


def _make_robot(parsed: _RobotFile) -> Robot:
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


def _read_effects(name: str) -> _EffectTables:
    source = f"{name}.toml"
    return _split_effects(parse_toml(read_robot_file(name), source, RobotFileError), source)[1]


def _is_shipped(name_or_file: str | Path) -> bool:
    return isinstance(name_or_file, str) and name_or_file in list_shipped_robots()


def _read_robot_text(path: Path) -> str:
    try:
        return read_text(path, RobotFileError, MAX_FILE_BYTES)
    except RobotFileError as error:
        if not isinstance(error.__cause__, FileNotFoundError):
            raise
        shipped_names = ", ".join(list_shipped_robots())
        raise RobotFileError(
            "{path}: no such robot file, and no shipped robot of that name (shipped: {known})",
            path=path,
            known=shipped_names,
        ) from error


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        MAX_BYTES="MAX_FILE_BYTES",
        SHIPPED="SHIPPED_ROBOTS_PACKAGE",
        nominal_robots="list_nominal_robots",
        robot_file_text="read_robot_file",
        shipped_robots="list_shipped_robots",
    )
