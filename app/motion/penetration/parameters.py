"""Parameters of a penetration, their bounds, and their file."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from enum import StrEnum
from math import isfinite
from os import PathLike, fspath
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple, Self

from rotemina.app.errors import PenetrationError
from rotemina.sim.files import parse_toml, read_text, replace_file
from rotemina.sim.messages import join_messages, message
from rotemina.sim.robot_files import suggest_keys
from rotemina.sim.units import format_exact

MAX_FILE_BYTES = 100_000
MAX_TABLE_POINTS = 200


class CellDirection(StrEnum):
    """Direction of the cell along the axis."""

    DOWN = "down"
    UP = "up"


class ThrustShape(StrEnum):
    """Speed profile of the thrust."""

    S_CURVE = "s_curve"
    MINIMUM_JERK = "minimum_jerk"
    TABLE = "table"


class InputShaping(StrEnum):
    """Input shaping that avoids exciting the resonance of the axis."""

    NONE = "none"
    ZV = "zv"
    ZVD = "zvd"
    ZVDD = "zvdd"
    INVERSE = "inverse"


class ParameterBound(NamedTuple):
    """Range of a parameter, and its SI unit; the unit of a ratio is empty."""

    minimum: float
    maximum: float
    unit: str


PARAMETER_BOUNDS = MappingProxyType(
    {
        "approach_speed": ParameterBound(1e-7, 2e-4, "m/s"),
        "approach_distance": ParameterBound(5e-7, 2e-3, "m"),
        "false_alarms_per_hour": ParameterBound(1e-3, 60.0, "1/h"),
        "drift": ParameterBound(0.001, 0.3, ""),
        "drift_length": ParameterBound(1e-6, 1e-2, "m"),
        "contact_pause_s": ParameterBound(0.02, 5.0, "s"),
        "depth": ParameterBound(1e-6, 1e-4, "m"),
        "duration_s": ParameterBound(2e-3, 1.0, "s"),
        "ramp": ParameterBound(0.05, 0.5, ""),
        "hold_s": ParameterBound(0.0, 60.0, "s"),
        "inject_s": ParameterBound(0.0, 60.0, "s"),
        "hold_after_s": ParameterBound(0.0, 60.0, "s"),
        "retract_speed": ParameterBound(1e-6, 1e-3, "m/s"),
        "depth_tolerance": ParameterBound(0.005, 0.5, ""),
        "overload": ParameterBound(1e-7, 5e-5, "m"),
        "armed_s": ParameterBound(5.0, 600.0, "s"),
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PenetrationParameters:
    """Parameters of a penetration, in SI units. Their bounds are :data:`PARAMETER_BOUNDS`.

    Attributes
    ----------
    axis : str
    direction : CellDirection
    approach_speed, approach_distance : float
        Speed and maximum length of the approach.
    false_alarms_per_hour, drift, drift_length : float
        Settings of the contact detection, see :mod:`rotemina.app.motion.penetration.detector`.
    contact_pause_s : float
        Time at rest on the membrane before the thrust.
    depth, duration_s : float
        Depth of the thrust below the contact, and its duration including input shaping.
    shape : ThrustShape
    ramp : float
        For an S-curve, the fraction of the duration in which it accelerates. Braking takes the
        same fraction.
    table : tuple of (time, depth)
        Points of a tabulated thrust, as fractions of duration and depth, from (0, 0) to (1, 1).
    shaping : InputShaping
    hold_s, inject_s, hold_after_s : float
        Times at full depth before the tool is switched on, while it is on, and afterwards. If
        ``inject_s`` is 0 the tool stays off.
    retract_speed : float
    depth_tolerance : float
        Permitted difference of the measured depth, as a fraction of the depth.
    overload : float
        Largest permitted change of ``meas − command``. A larger change ends the run.
    armed_s : float
        Time after which an armed penetration is disarmed automatically.

    Raises
    ------
    PenetrationError
        If a parameter is out of its bounds. The message names parameter, value and bound.
    """

    axis: str = "zn"
    direction: CellDirection = CellDirection.DOWN
    approach_speed: float = 1e-5
    approach_distance: float = 1e-5
    false_alarms_per_hour: float = 1.0
    drift: float = 0.15
    drift_length: float = 1e-3
    contact_pause_s: float = 0.1
    depth: float = 5e-5
    duration_s: float = 0.09
    shape: ThrustShape = ThrustShape.S_CURVE
    ramp: float = 0.3
    table: tuple[tuple[float, float], ...] = ()
    shaping: InputShaping = InputShaping.ZVD
    hold_s: float = 0.5
    inject_s: float = 0.0
    hold_after_s: float = 0.0
    retract_speed: float = 1e-4
    depth_tolerance: float = 0.1
    overload: float = 1e-5
    armed_s: float = 60.0

    def __post_init__(self) -> None:
        if not isinstance(self.axis, str) or not self.axis:
            raise PenetrationError(
                "axis = {axis}: must be the name of an axis", axis=repr(self.axis)
            )
        for name, choices in (
            ("direction", CellDirection),
            ("shape", ThrustShape),
            ("shaping", InputShaping),
        ):
            object.__setattr__(self, name, _check_choice(name, getattr(self, name), choices))
        for name, bound in PARAMETER_BOUNDS.items():
            object.__setattr__(self, name, _check_number(name, getattr(self, name), bound))
        object.__setattr__(self, "table", _check_table(self.table))
        if (self.shape is ThrustShape.TABLE) != bool(self.table):
            raise PenetrationError(
                "table: must be given if and only if shape is 'table' (shape is {shape}, the "
                "table has {count} points)",
                shape=repr(str(self.shape)),
                count=len(self.table),
            )

    @property
    def sign(self) -> float:
        """Sign of the thrust along the axis: 1.0 or -1.0."""
        return 1.0 if self.direction is CellDirection.UP else -1.0

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Read parameters from a TOML file; parameters that the file omits keep their presets.

        Raises
        ------
        PenetrationError
            If the file is invalid. The message names file, key, value and bound.
        """
        text, name = read_text(path, PenetrationError, MAX_FILE_BYTES), fspath(path)
        table = parse_toml(text, name, PenetrationError)
        try:
            return cls._from_table(table)
        except PenetrationError as error:
            raise PenetrationError("{name}: {error}", name=name, error=str(error)) from error

    @classmethod
    def load_or_default(cls, path: Path) -> Self:
        """Read a file like :meth:`load`, or return the presets if the file does not exist."""
        return cls.load(path) if path.exists() else cls()

    @classmethod
    def from_text(cls, text: str) -> Self:
        """Read parameters from the text of a parameter file."""
        return cls._from_table(parse_toml(text, "parameters", PenetrationError))

    @classmethod
    def _from_table(cls, table: Mapping[str, Any]) -> Self:
        known_keys = [field.name for field in fields(cls)]
        for key, value in table.items():
            if key not in known_keys:
                problem = message("engine", "{key} = {value}: unknown key").fill(
                    key=key, value=repr(value)
                )
                raise PenetrationError(
                    join_messages((problem, *suggest_keys(key, known_keys)), "; ")
                )
        return cls(**table)

    def text(self) -> str:
        """Return the text of a parameter file from which the same parameters are read."""
        lines = ["# Automatic cell penetration; SI units (m, m/s, s)."]
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name == "table":
                rows = ", ".join(f"[{time!r}, {depth!r}]" for time, depth in value)
                lines += [f"table = [{rows}]"] if value else []
            else:
                lines.append(f"{field.name} = {_format_value(value)}")
        return "\n".join(lines) + "\n"

    def save(self, path: str | PathLike[str]) -> None:
        """Write the file atomically, and create its folder if needed.

        Raises
        ------
        FileWriteError
            If the file cannot be written.
        """
        # If the folder cannot be created, writing the file fails and reports the reason.
        with suppress(OSError):
            Path(path).parent.mkdir(parents=True, exist_ok=True)
        with replace_file(path) as file:
            file.write(self.text().encode())


def _format_value(value: object) -> str:
    if isinstance(value, str):
        return '"' + str(value).replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value)


def _check_choice(name: str, value: object, choices: type[StrEnum]) -> StrEnum:
    try:
        return choices(value)  # type: ignore[arg-type]  # values other than text are refused as well
    except ValueError:
        valid_choices = ", ".join(repr(str(choice)) for choice in choices)
        raise PenetrationError(
            "{name} = {value}: must be one of {known}",
            name=name,
            value=repr(value),
            known=valid_choices,
        ) from None


def _check_number(name: str, value: object, bound: ParameterBound) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise PenetrationError(
            "{name} = {value}: must be a finite number", name=name, value=repr(value)
        )
    if not bound.minimum <= value <= bound.maximum:
        raise PenetrationError(
            "{name} = {value}: must be {least} to {most}",
            name=name,
            value=format_exact(value, bound.unit).strip(),
            least=format_exact(bound.minimum, bound.unit).strip(),
            most=format_exact(bound.maximum, bound.unit).strip(),
        )
    return float(value)


def _check_table(rows: Any) -> tuple[tuple[float, float], ...]:
    """Return the points of a table as floats.

    :mod:`rotemina.sim.shaping.moves` checks that they rise monotonically.
    """
    if not isinstance(rows, list | tuple) or len(rows) > MAX_TABLE_POINTS:
        raise PenetrationError(
            "table: must be a list of at most {most_points} points", most_points=MAX_TABLE_POINTS
        )
    points = []
    for number, row in enumerate(rows, 1):
        if not isinstance(row, list | tuple) or len(row) != 2:
            raise PenetrationError(
                "table, point {number} = {row}: must be [time, depth]", number=number, row=repr(row)
            )
        unit_interval = ParameterBound(0.0, 1.0, "")
        points.append(
            (
                _check_number(f"table, point {number}, time", row[0], unit_interval),
                _check_number(f"table, point {number}, depth", row[1], unit_interval),
            )
        )
    if points and (points[0] != (0.0, 0.0) or points[-1] != (1.0, 1.0)):
        raise PenetrationError("table: must go from [0, 0] to [1, 1]")
    return tuple(points)
