"""The columns of a record file: what its header names, and what separates its fields."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rotemina.sim.messages import Listed, message
from rotemina.sim.records.fields import (
    BLANKS,
    NOT_FINITE,
    NUMBER,
    PADDING,
    SEPARATORS,
    split_fields,
    with_plain_blanks,
    without_padding,
)
from rotemina.sim.records.record import VOLTAGE_TAPS, Channel, RecordError, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.units import UnitError, canonical, per_si, quantity

EXAMPLE = "t [s], x [mm], y [mm]"
_LONGEST_NAME = 100
_TAPS = tuple(tap.value for tap in Tap)

_COLUMN = re.compile(r"([^\[\]]+)\[([^\[\]]*)\]")
_COLUMN_IN_ROUND_BRACKETS = re.compile(r"([^\[\]()]+)\(([^\[\]()]*)\)")
_QUOTES_AND_UNITS = re.compile(r'"[^"]*"|\[[^\[\]]*\]')
_BLANKS_AFTER_UNIT = re.compile(r"(?<=\])[ \t]+")
_BLANKS_AFTER_ROUND_UNIT = re.compile(r"(?<=\))[ \t]+")
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


def looks_like_header(line: str) -> bool:
    """Return whether a line is a header rather than numbers, by its first field."""
    first = re.split(r"[\s;,]", line.strip(PADDING).removeprefix('"'), maxsplit=1)[0]
    return first[:1].isalpha() and NOT_FINITE.fullmatch(first.removesuffix('"')) is None


def header_separator(line: str) -> str:
    """Return what separates the headings of a header row."""
    outside = _QUOTES_AND_UNITS.sub("", line)
    return next((sign for sign in (";", ",", "\t") if sign in outside), " ")


def row_separator(line: str, count: int) -> str | None:
    """Return the separator that makes ``count`` numbers of a row, or None if none does."""
    signs = (sign for sign in SEPARATORS if splits_into_numbers(line, sign, count))
    return next(signs, None)


def splits_into_numbers(line: str, separator: str, count: int) -> bool:
    """Return whether a separator makes ``count`` numbers of a row, with either decimal sign."""
    fields = without_padding(split_fields(line, separator), count)
    fields = [field.replace(",", ".", 1) for field in fields]
    return len(fields) == count and all(NUMBER.fullmatch(field) for field in fields)


def split_headings(line: str, separator: str) -> list[str]:
    """Split a header row into headings; a heading may hold a blank before its unit."""
    line = with_plain_blanks(line)
    if separator == " " and '"' not in line:
        for bracket, blanks in (("[", _BLANKS_AFTER_UNIT), ("(", _BLANKS_AFTER_ROUND_UNIT)):
            if bracket in line:
                return blanks.split(line.strip(BLANKS))
    return without_padding(split_fields(line, separator), 1)


def with_units_below(headings: Sequence[str], line: str, separator: str) -> list[str] | None:
    """Return headings with the units that the line below names, or None if it names none.

    Where the headings have units themselves, the line below may only repeat them.
    """
    units = [field.strip("[]() ") for field in split_headings(line, separator)]
    if len(units) != len(headings) or not all(map(_is_unit, units)):
        return None
    names = [re.sub(r"[\[(].*", "", heading).strip(BLANKS) for heading in headings]
    joined = [f"{name} [{unit}]" for name, unit in zip(names, units, strict=True)]
    if not any(map(_has_unit, headings)):
        return joined
    try:
        repeated = columns_of(headings, "") == columns_of(joined, "")
    except RecordError:
        return None
    return joined if repeated else None


def _is_unit(text: str) -> bool:
    try:
        canonical(text)
    except UnitError:
        return False
    return True


def _has_unit(heading: str) -> bool:
    return "[" in heading or "(" in heading


def is_header_again(line: str, separator: str) -> bool:
    """Return whether a line among the rows is a header, which begins with the name of time."""
    first = split_headings(line, separator)[0]
    return re.sub(r"[\[(].*", "", first).strip(BLANKS) == "t"


def parse_columns(
    line: str, where: str, robot: Robot | None = None, *, separator: str | None = None
) -> tuple[Column, ...]:
    """Return the columns that a header row, or the user, names.

    Parameters
    ----------
    line : such as ``t [s], x [mm], y.meas [um]``; a bare ``x`` is ``x.cmd``.
    where : file and line, the first part of every error.
    robot : if given, its axes and the kinds of their units must fit.
    separator : of the headings; found in the line where left out.

    Raises
    ------
    RecordError
        If a heading, axis, channel or unit is unknown or named twice.
    """
    headings = split_headings(line, separator or header_separator(line))
    return columns_of(headings, where, robot)


def columns_of(
    headings: Sequence[str], where: str, robot: Robot | None = None
) -> tuple[Column, ...]:
    """Return the columns that headings name; parameters and errors of :func:`parse_columns`."""
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
    match = _COLUMN.fullmatch(heading) or _COLUMN_IN_ROUND_BRACKETS.fullmatch(heading)
    if match is None:
        raise _not_a_heading(heading, where, first=first)
    name, unit_text = match[1].strip(BLANKS), match[2].strip(BLANKS)
    try:
        unit = canonical(unit_text)
    except UnitError as error:
        raise RecordError(
            message("engine", "{where}: {name}: {error}").fill(
                where=where, name=repr(name), error=str(error)
            )
        ) from error
    if first != (name == "t"):
        raise RecordError(
            message(
                "engine",
                "{where}: heading {heading}; the first column, and only it, must be time: t [s]",
            ).fill(where=where, heading=repr(heading))
        )
    channel = None if first else _parse_channel(name, where)
    _check_unit(channel, unit, where)
    return Column(channel, unit)


def _not_a_heading(heading: str, where: str, *, first: bool) -> RecordError:
    text = message(
        "engine",
        "{where}: heading {heading} is not 'axis.channel [unit]'; write it like {example}",
    )
    if '"' in heading:
        text = message(
            "engine",
            "{where}: heading {heading} has a quote without its partner on this line; write each "
            "heading on one line, like {example}",
        )
    elif first:
        text = message(
            "engine",
            "{where}: heading {heading} is not 'axis.channel [unit]'; write it like {example}, and "
            "begin lines above the header with '#'",
        )
    return RecordError(text.fill(where=where, heading=repr(heading), example=EXAMPLE))


def _parse_channel(name: str, where: str) -> Channel:
    axis, dot, tap = name.rpartition(".")
    axis, tap = (axis, tap) if dot else (name, Tap.CMD.value)
    if tap not in _TAPS:
        raise RecordError(
            message("engine", "{where}: unknown channel {tap} in {name}; use one of {names}").fill(
                where=where, tap=repr(tap), name=repr(name), names=" ".join(_TAPS)
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
            ).fill(where=where, axis=repr(axis), longest_name=_LONGEST_NAME)
        )


def _check_unit(channel: Channel | None, unit: str, where: str) -> None:
    allowed = ("s",) if channel is None else ("V",) if channel.tap in VOLTAGE_TAPS else ("m", "rad")
    if quantity(unit) not in allowed:
        raise RecordError(
            message("engine", "{where}: {value} cannot be in [{unit}]; use a unit of {names}").fill(
                where=where,
                value=str(channel or "t"),
                unit=unit,
                names=Listed(allowed, one_of_them=True),
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
