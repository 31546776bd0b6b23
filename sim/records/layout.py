"""The columns of a record file: what its header names, and what separates its fields."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rotemina.sim.messages import message
from rotemina.sim.records.metadata import BLANKS
from rotemina.sim.records.record import VOLTAGE_TAPS, Channel, RecordError, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.units import UnitError, canonical, per_si, quantity

# In the order in which they are looked for: a comma may also be a decimal sign, a blank a filler.
SEPARATORS = (";", "\t", ",", " ")
EXAMPLE = "t [s], x [mm], y [mm]"
_LONGEST_NAME = 100
_TAPS = tuple(tap.value for tap in Tap)

# ASCII digits with one sign, one point, one exponent: no "1_000", no "0x10", no "nan".
NUMBER = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
_COLUMN = re.compile(r"([^\[\]]+)\[([^\[\]]*)\]")
_BLANKS_AFTER_UNIT = re.compile(r"(?<=\])[ \t]+")
_AXIS_NAME = re.compile(r"[^\s,;\[\]\"'#=+@\-.][^,;\[\]\"#\x00-\x1f\x7f]*(?<!\s)")


@dataclass(frozen=True, slots=True)
class Column:
    """One column of a file: a channel, or None for time, and the unit of its numbers."""

    channel: Channel | None
    unit: str

    def __str__(self) -> str:
        return "t" if self.channel is None else str(self.channel)

    @property
    def heading(self) -> str:
        """The heading of the column: ``x.cmd [mm]``."""
        return f"{self} [{self.unit}]"


@dataclass(frozen=True, slots=True)
class Layout:
    """How rows are to be read: the separator of fields and the columns, time first."""

    separator: str
    columns: tuple[Column, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The columns' names, as errors show them."""
        return tuple(str(column) for column in self.columns)

    @property
    def channels(self) -> tuple[Channel, ...]:
        """The columns without time."""
        return tuple(column.channel for column in self.columns if column.channel is not None)

    @property
    def per_si(self) -> tuple[float, ...]:
        """The divisor of each column to SI."""
        return tuple(per_si(column.unit) for column in self.columns)

    @property
    def axis_units(self) -> Mapping[str, str]:
        """Map each axis to ``"m"`` or ``"rad"``."""
        return {
            column.channel.axis: quantity(column.unit)
            for column in self.columns
            if column.channel is not None and column.channel.tap not in VOLTAGE_TAPS
        }


def split_fields(line: str, separator: str) -> list[str]:
    """Split one line into fields without the blanks around them."""
    if separator == " ":
        return re.split(r"[ \t]+", line.strip(BLANKS))
    return [field.strip(BLANKS) for field in line.split(separator)]


def looks_like_header(line: str) -> bool:
    """Return whether a line is a header rather than numbers, by its first field."""
    first = re.split(r"[\s;,]", line.strip(BLANKS), maxsplit=1)[0]
    return '"' in first or (first[:1].isalpha() and _NOT_FINITE.fullmatch(first) is None)


def header_separator(line: str) -> str:
    """Return what separates the headings of a header row."""
    outside = re.sub(r"\[[^\[\]]*\]", "", line)
    return next((sign for sign in (";", ",", "\t") if sign in outside), " ")


def row_separator(line: str, count: int) -> str | None:
    """Return the separator that makes ``count`` numbers of a row, or None if none does."""
    signs = (sign for sign in SEPARATORS if splits_into_numbers(line, sign, count))
    return next(signs, None)


def splits_into_numbers(line: str, separator: str, count: int) -> bool:
    """Return whether a separator makes ``count`` numbers of a row, with either decimal sign."""
    fields = split_fields(line, separator)
    if separator != ",":
        fields = [field.replace(",", ".", 1) for field in fields]
    return len(fields) == count and all(NUMBER.fullmatch(field) for field in fields)


def split_headings(line: str, separator: str) -> list[str]:
    """Split a header row into headings; a heading may hold a blank before its unit."""
    if separator == " ":
        return _BLANKS_AFTER_UNIT.split(line.strip(BLANKS))
    return split_fields(line, separator)


def parse_columns(line: str, where: str, robot: Robot | None = None) -> tuple[Column, ...]:
    """Return the columns that a header row, or the user, names.

    Parameters
    ----------
    line : such as ``t [s], x [mm], y.meas [um]``; a bare ``x`` is ``x.cmd``.
    where : file and line, the first part of every error.
    robot : if given, its axes and the kinds of their units must fit.

    Raises
    ------
    RecordError
        If a heading, axis, channel or unit is unknown or named twice.
    """
    headings = split_headings(line, header_separator(line))
    columns = [
        _parse_column(heading, f"{where}:{number}", first=number == 1)
        for number, heading in enumerate(headings, start=1)
    ]
    _check_unique(columns, where)
    _check_axes(columns, where)
    if robot is not None:
        _check_robot(columns, where, robot)
    return tuple(columns)


def _parse_column(heading: str, where: str, *, first: bool) -> Column:
    match = _COLUMN.fullmatch(heading)
    if match is None:
        raise RecordError(
            message(
                "engine",
                "{where}: heading {heading} is not 'axis.channel [unit]'; write it like {example}",
            ).fill(where=where, heading=repr(heading[:40]), example=EXAMPLE)
        )
    name, unit_text = match[1].strip(BLANKS), match[2].strip(BLANKS)
    try:
        unit = canonical(unit_text)
    except UnitError as error:
        raise RecordError(
            message("engine", "{where}: {name}: {error}").fill(
                where=where, name=repr(name[:40]), error=str(error)
            )
        ) from error
    if first != (name == "t"):
        raise RecordError(
            message(
                "engine",
                "{where}: heading {heading}; the first column, and only it, must be time: t [s]",
            ).fill(where=where, heading=repr(heading[:40]))
        )
    channel = None if first else _parse_channel(name, where)
    _check_unit(channel, unit, where)
    return Column(channel, unit)


def _parse_channel(name: str, where: str) -> Channel:
    axis, dot, tap = name.rpartition(".")
    axis, tap = (axis, tap) if dot else (name, Tap.CMD.value)
    if tap not in _TAPS:
        raise RecordError(
            message("engine", "{where}: unknown channel {tap} in {name}; use one of {names}").fill(
                where=where, tap=repr(tap[:40]), name=repr(name[:40]), names=" ".join(_TAPS)
            )
        )
    check_axis_name(axis, where)
    return Channel(axis, Tap(tap))


def check_axis_name(axis: str, where: str) -> None:
    """Refuse an axis name that a header could not carry, or that a spreadsheet would calculate."""
    proper = _AXIS_NAME.fullmatch(axis) is not None and axis.isprintable()
    if not proper or len(axis) > _LONGEST_NAME:
        raise RecordError(
            message(
                "engine",
                "{where}: {axis} cannot name an axis; begin with a letter, and use no separators, "
                "brackets, quotes or '#' and at most {longest_name} characters",
            ).fill(where=where, axis=repr(axis[:40]), longest_name=_LONGEST_NAME)
        )


def _check_unit(channel: Channel | None, unit: str, where: str) -> None:
    allowed = ("s",) if channel is None else ("V",) if channel.tap in VOLTAGE_TAPS else ("m", "rad")
    if quantity(unit) not in allowed:
        raise RecordError(
            message("engine", "{where}: {value} cannot be in [{unit}]; use a unit of {names}").fill(
                where=where, value=str(channel or "t"), unit=unit, names=" or ".join(allowed)
            )
        )


def _check_unique(columns: Sequence[Column], where: str) -> None:
    seen: dict[str, int] = {}
    for number, column in enumerate(columns, start=1):
        before = seen.setdefault(str(column), number)
        if before != number:
            raise RecordError(
                message(
                    "engine",
                    "{where}:{number}: column {column} is already column {before}; remove one",
                ).fill(where=where, number=number, column=str(column), before=before)
            )
    if len(columns) < 2:
        raise RecordError(
            message("engine", "{where}: no column beside time; add one, such as {example}").fill(
                where=where, example=EXAMPLE
            )
        )


def _check_axes(columns: Iterable[Column], where: str) -> None:
    """Check that each axis has a command, and is a length or an angle in all its columns."""
    kinds: dict[str, str] = {}
    positions = [column for column in columns if column.channel is not None]
    for number, column in enumerate(positions, start=2):
        assert column.channel is not None
        axis, tap = column.channel
        if tap not in VOLTAGE_TAPS:
            kind = kinds.setdefault(axis, quantity(column.unit))
            if kind != quantity(column.unit):
                raise RecordError(
                    message(
                        "engine",
                        "{where}:{number}: {column} is in [{unit}] but {axis} is in units of "
                        "{kind} before; one of them is wrong",
                    ).fill(
                        where=where,
                        number=number,
                        column=str(column),
                        unit=column.unit,
                        axis=repr(axis),
                        kind=kind,
                    )
                )
    check_commands([column.channel for column in positions if column.channel], where)


def check_commands(channels: Iterable[Channel], where: str) -> None:
    """Refuse an axis without its command, the only channel that may not be missing."""
    channels = tuple(channels)
    commanded = {axis for axis, tap in channels if tap is Tap.CMD}
    for axis, tap in channels:
        if axis not in commanded:
            raise RecordError(
                message(
                    "engine", "{where}: axis {quoted} has {axis}.{tap} but no {axis}.cmd; add it"
                ).fill(where=where, quoted=repr(axis), axis=axis, tap=tap)
            )


def _check_robot(columns: Iterable[Column], where: str, robot: Robot) -> None:
    for number, column in enumerate(columns, start=1):
        if column.channel is None:
            continue
        axis, tap = column.channel
        if axis not in robot.axes:
            raise RecordError(
                message(
                    "engine",
                    "{where}:{number}: robot {name} has no axis {axis}; its axes are {names}",
                ).fill(
                    where=where,
                    number=number,
                    name=repr(robot.name),
                    axis=repr(axis),
                    names=" ".join(robot.axes),
                )
            )
        kind = robot.unit(axis)
        if tap not in VOLTAGE_TAPS and kind is not None and quantity(column.unit) != kind:
            raise RecordError(
                message(
                    "engine",
                    "{where}:{number}: {column} is in [{unit}] but robot {name} moves {axis} in "
                    "units of {kind}; correct the unit",
                ).fill(
                    where=where,
                    number=number,
                    column=str(column),
                    unit=column.unit,
                    name=repr(robot.name),
                    axis=repr(axis),
                    kind=kind,
                )
            )
