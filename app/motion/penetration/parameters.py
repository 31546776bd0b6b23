"""Parameters of a penetration, with bounds, and their file."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from enum import StrEnum
from math import isfinite
from os import PathLike, fspath
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple, Self

from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_toml, read_text
from rotemina.sim.messages import joined, message
from rotemina.sim.quantities import exact
from rotemina.sim.robot.schema_errors import suggestion
from rotemina.sim.whole_files import replaced

MAX_BYTES = 100_000
MOST_POINTS = 200


class PenetrationError(InputError):
    """Parameters, or a machine, with which no penetration is possible; says what and the bound."""


class Direction(StrEnum):
    """Direction of the cell along the axis."""

    DOWN = "down"
    UP = "up"


class ThrustShape(StrEnum):
    """The speed profile of the thrust."""

    S_CURVE = "s_curve"
    MINIMUM_JERK = "minimum_jerk"
    TABLE = "table"


class Shaping(StrEnum):
    """Input shaping against the axis' resonance."""

    NONE = "none"
    ZV = "zv"
    ZVD = "zvd"
    ZVDD = "zvdd"
    INVERSE = "inverse"


class Bound(NamedTuple):
    """The least and greatest value of a parameter, and its unit (SI; empty for a share)."""

    least: float
    most: float
    unit: str


BOUNDS = MappingProxyType(
    {
        "approach_speed": Bound(1e-7, 2e-4, "m/s"),
        "approach_distance": Bound(5e-7, 2e-3, "m"),
        "false_alarms_per_hour": Bound(1e-3, 60.0, "1/h"),
        "drift": Bound(0.001, 0.3, ""),
        "drift_length": Bound(1e-6, 1e-2, "m"),
        "contact_pause_s": Bound(0.02, 5.0, "s"),
        "depth": Bound(1e-6, 1e-4, "m"),
        "duration_s": Bound(2e-3, 1.0, "s"),
        "ramp": Bound(0.05, 0.5, ""),
        "hold_s": Bound(0.0, 60.0, "s"),
        "inject_s": Bound(0.0, 60.0, "s"),
        "hold_after_s": Bound(0.0, 60.0, "s"),
        "retract_speed": Bound(1e-6, 1e-3, "m/s"),
        "depth_tolerance": Bound(0.005, 0.5, ""),
        "overload": Bound(1e-7, 5e-5, "m"),
        "armed_s": Bound(5.0, 600.0, "s"),
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PenetrationParameters:
    """SI units; the bounds are :data:`BOUNDS`.

    Attributes
    ----------
    axis : str
    direction : Direction
    approach_speed, approach_distance : float
        How fast the tip comes near, and how far at most.
    false_alarms_per_hour, drift, drift_length : float
        Of the contact's detection, see :mod:`rotemina.app.motion.penetration.detector`.
    contact_pause_s : float
        At rest on the membrane, before the thrust.
    depth, duration_s : float
        Of the thrust, from the place of the contact; input shaping counts to the duration.
    shape : ThrustShape
    ramp : float
        Of an S-curve: share of the time in which it speeds up, and again in which it slows down.
    table : tuple of (time, depth)
        Of a tabled thrust, as shares of duration and depth: from (0, 0) to (1, 1).
    shaping : Shaping
    hold_s, inject_s, hold_after_s : float
        At the bottom: before the tool is on, with it on, and after that. Without a time to inject
        the tool stays off.
    retract_speed : float
    depth_tolerance : float
        Share of the depth by which the one that was reached may differ.
    overload : float
        Greatest change of ``meas − command``: more ends it.
    armed_s : float
        After which it disarms by itself.

    Raises
    ------
    PenetrationError
        With parameter, value and bound.
    """

    axis: str = "zn"
    direction: Direction = Direction.DOWN
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
    shaping: Shaping = Shaping.ZVD
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
                message("engine", "axis = {axis}: must be the name of an axis").fill(
                    axis=repr(self.axis)
                )
            )
        for name, kind in (("direction", Direction), ("shape", ThrustShape), ("shaping", Shaping)):
            object.__setattr__(self, name, _choice(name, getattr(self, name), kind))
        for name, bound in BOUNDS.items():
            object.__setattr__(self, name, _number(name, getattr(self, name), bound))
        object.__setattr__(self, "table", _table(self.table))
        if (self.shape is ThrustShape.TABLE) != bool(self.table):
            raise PenetrationError(
                message(
                    "engine",
                    "table: permitted only for a thrust of shape 'table', which needs it "
                    "(shape is {shape}, the table has {count} points)",
                ).fill(shape=repr(str(self.shape)), count=len(self.table))
            )

    @property
    def sign(self) -> float:
        """Of the thrust along the axis."""
        return 1.0 if self.direction is Direction.UP else -1.0

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Read parameters from a TOML file; those that it does not name have their preset.

        Raises
        ------
        PenetrationError
            With file, key, value and bound.
        """
        text, name = read_text(path, PenetrationError, MAX_BYTES), fspath(path)
        table = parse_toml(text, name, PenetrationError)
        try:
            return cls._of(table)
        except PenetrationError as error:
            raise PenetrationError(
                message("engine", "{name}: {error}").fill(name=name, error=str(error))
            ) from error

    @classmethod
    def kept(cls, path: Path) -> Self:
        """Read a file that may be missing: presets then; else as :meth:`load`."""
        return cls.load(path) if path.exists() else cls()

    @classmethod
    def parsed(cls, text: str) -> Self:
        """Read parameters from the text of such a file."""
        return cls._of(parse_toml(text, "parameters", PenetrationError))

    @classmethod
    def _of(cls, table: Mapping[str, Any]) -> Self:
        known = [field.name for field in fields(cls)]
        for key, value in table.items():
            if key not in known:
                said = message("engine", "{key} = {value}: unknown key").fill(
                    key=key, value=repr(value)
                )
                raise PenetrationError(joined((said, *suggestion(key, known)), "; "))
        return cls(**table)

    def text(self) -> str:
        """Return the file's text; it reads back to the same parameters."""
        lines = ["# Automatic cell penetration; SI units (m, m/s, s)."]
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name == "table":
                rows = ", ".join(f"[{at!r}, {depth!r}]" for at, depth in value)
                lines += [f"table = [{rows}]"] if value else []
            else:
                lines.append(f"{field.name} = {_written(value)}")
        return "\n".join(lines) + "\n"

    def save(self, path: str | PathLike[str]) -> None:
        """Write the file, completely or not at all; its folder is made.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        with suppress(OSError):  # what is wrong is said by the writing
            Path(path).parent.mkdir(parents=True, exist_ok=True)
        with replaced(path) as file:
            file.write(self.text().encode())


def _written(value: object) -> str:
    if isinstance(value, str):
        return '"' + str(value).replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value)


def _choice(name: str, value: object, kind: type[StrEnum]) -> StrEnum:
    try:
        return kind(value)  # type: ignore[arg-type]  # what is no text is refused alike
    except ValueError:
        known = ", ".join(repr(str(one)) for one in kind)
        raise PenetrationError(
            message("engine", "{name} = {value}: must be one of {known}").fill(
                name=name, value=repr(value), known=known
            )
        ) from None


def _number(name: str, value: object, bound: Bound) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise PenetrationError(
            message("engine", "{name} = {value}: must be a finite number").fill(
                name=name, value=repr(value)
            )
        )
    if not bound.least <= value <= bound.most:
        raise PenetrationError(
            message("engine", "{name} = {value}: must be {least} to {most}").fill(
                name=name,
                value=exact(value, bound.unit).strip(),
                least=exact(bound.least, bound.unit).strip(),
                most=exact(bound.most, bound.unit).strip(),
            )
        )
    return float(value)


def _table(rows: Any) -> tuple[tuple[float, float], ...]:
    """Return the points of a table as floats; :mod:`rotemina.sim.shaping.moves` judges them."""
    if not isinstance(rows, list | tuple) or len(rows) > MOST_POINTS:
        raise PenetrationError(
            message("engine", "table: must be a list of at most {most_points} points").fill(
                most_points=MOST_POINTS
            )
        )
    found = []
    for number, row in enumerate(rows, 1):
        if not isinstance(row, list | tuple) or len(row) != 2:
            raise PenetrationError(
                message("engine", "table, point {number} = {row}: must be [time, depth]").fill(
                    number=number, row=repr(row)
                )
            )
        share = Bound(0.0, 1.0, "")
        found.append(
            (
                _number(f"table, point {number}, time", row[0], share),
                _number(f"table, point {number}, depth", row[1], share),
            )
        )
    if found and (found[0] != (0.0, 0.0) or found[-1] != (1.0, 1.0)):
        raise PenetrationError(message("engine", "table: must go from [0, 0] to [1, 1]"))
    return tuple(found)
