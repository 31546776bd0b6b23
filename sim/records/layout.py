"""The layout of a record file: the columns in its header, and the separator of its fields."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rotemina.sim.errors import RecordError, UnitError
from rotemina.sim.messages import FieldList, message
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
from rotemina.sim.records.record import VOLTAGE_TAPS, RecordChannel, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.units import parse_unit, per_si, si_unit_of

EXAMPLE_HEADER = "t [s], x [mm], y [mm]"
_MAX_NAME_LENGTH = 100
_TAPS = tuple(tap.value for tap in Tap)

_COLUMN = re.compile(r"([^\[\]]+)\[([^\[\]]*)\]")
_COLUMN_IN_ROUND_BRACKETS = re.compile(r"([^\[\]()]+)\(([^\[\]()]*)\)")
_QUOTES_AND_UNITS = re.compile(r'"[^"]*"|\[[^\[\]]*\]')
_BLANKS_AFTER_UNIT = re.compile(r"(?<=\])[ \t]+")
_BLANKS_AFTER_ROUND_UNIT = re.compile(r"(?<=\))[ \t]+")
_AXIS_NAME = re.compile(r"[^\s,;\[\]\"'#=+@\-.][^,;\[\]\"#\x00-\x1f\x7f]*(?<!\s)")


@dataclass(frozen=True, slots=True)
class FileColumn:
    """One column of a file: its channel (None for time) and the unit of its numbers."""

    channel: RecordChannel | None
    unit: str

    def __str__(self) -> str:
        return "t" if self.channel is None else str(self.channel)

    @property
    def heading(self) -> str:
        """The heading of the column: ``x.cmd [mm]``."""
        return f"{self} [{self.unit}]"


@dataclass(frozen=True, slots=True)
class FileLayout:
    """The layout of rows: the separator of fields and the columns, time first."""

    separator: str
    columns: tuple[FileColumn, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, as errors show them."""
        return tuple(str(column) for column in self.columns)

    @property
    def channels(self) -> tuple[RecordChannel, ...]:
        """The columns without time."""
        return tuple(column.channel for column in self.columns if column.channel is not None)

    @property
    def per_si(self) -> tuple[float, ...]:
        """The divisor of each column for the conversion to SI."""
        return tuple(per_si(column.unit) for column in self.columns)

    @property
    def axis_units(self) -> Mapping[str, str]:
        """The unit of each axis, ``"m"`` or ``"rad"``."""
        return {
            column.channel.axis: si_unit_of(column.unit)
            for column in self.columns
            if column.channel is not None and column.channel.tap not in VOLTAGE_TAPS
        }


def looks_like_header(line: str) -> bool:
    """Return whether a line is a header rather than numbers, judging by its first field."""
    first_field = re.split(r"[\s;,]", line.strip(PADDING).removeprefix('"'), maxsplit=1)[0]
    return first_field[:1].isalpha() and NOT_FINITE.fullmatch(first_field.removesuffix('"')) is None


def find_header_separator(line: str) -> str:
    """Return the separator of the headings of a header row."""
    text_outside_units = _QUOTES_AND_UNITS.sub("", line)
    return next((sign for sign in (";", ",", "\t") if sign in text_outside_units), " ")


def find_row_separator(line: str, count: int) -> str | None:
    """Return the separator that splits a row into ``count`` numbers, or None if none does."""
    separators = (sign for sign in SEPARATORS if splits_into_numbers(line, sign, count))
    return next(separators, None)


def splits_into_numbers(line: str, separator: str, count: int) -> bool:
    """Return whether a separator splits a row into ``count`` numbers, with either decimal sign."""
    fields = without_padding(split_fields(line, separator), count)
    fields = [field.replace(",", ".", 1) for field in fields]
    return len(fields) == count and all(NUMBER.fullmatch(field) for field in fields)


def split_headings(line: str, separator: str) -> list[str]:
    """Split a header row into headings; a heading may contain a blank before its unit."""
    line = with_plain_blanks(line)
    if separator == " " and '"' not in line:
        for bracket, blanks in (("[", _BLANKS_AFTER_UNIT), ("(", _BLANKS_AFTER_ROUND_UNIT)):
            if bracket in line:
                return blanks.split(line.strip(BLANKS))
    return without_padding(split_fields(line, separator), 1)


def with_units_below(headings: Sequence[str], line: str, separator: str) -> list[str] | None:
    """Return headings with the units from the line below, or None if that line does not list units.

    If the headings have units themselves, the line below may only repeat them.
    """
    units = [field.strip("[]() ") for field in split_headings(line, separator)]
    if len(units) != len(headings) or not all(map(_is_unit, units)):
        return None
    names = [re.sub(r"[\[(].*", "", heading).strip(BLANKS) for heading in headings]
    headings_with_units = [f"{name} [{unit}]" for name, unit in zip(names, units, strict=True)]
    if not any(map(_has_unit, headings)):
        return headings_with_units
    try:
        is_repetition = parse_headings(headings, "") == parse_headings(headings_with_units, "")
    except RecordError:
        return None
    return headings_with_units if is_repetition else None


def _is_unit(text: str) -> bool:
    try:
        parse_unit(text)
    except UnitError:
        return False
    return True


def _has_unit(heading: str) -> bool:
    return "[" in heading or "(" in heading


def is_repeated_header(line: str, separator: str) -> bool:
    """Return whether a line among the rows is a header, which begins with ``t``."""
    first_heading = split_headings(line, separator)[0]
    return re.sub(r"[\[(].*", "", first_heading).strip(BLANKS) == "t"


def parse_columns(
    line: str, where: str, robot: Robot | None = None, *, separator: str | None = None
) -> tuple[FileColumn, ...]:
    """Return the columns that a header row or the user names.

    Parameters
    ----------
    line : such as ``t [s], x [mm], y.meas [um]``; a bare ``x`` means ``x.cmd``.
    where : file and line, the first part of every error.
    robot : if given, the axes must be its axes, in units of the right quantity.
    separator : of the headings; by default it is found from the line.

    Raises
    ------
    RecordError
        If a heading, axis, channel or unit is unknown, or a column is named twice.
    """
    headings = split_headings(line, separator or find_header_separator(line))
    return parse_headings(headings, where, robot)


def parse_headings(
    headings: Sequence[str], where: str, robot: Robot | None = None
) -> tuple[FileColumn, ...]:
    """Return the columns that headings name; parameters and errors as in :func:`parse_columns`."""
    columns = [
        _parse_column(heading, f"{where}:{number}", is_first=number == 1)
        for number, heading in enumerate(headings, start=1)
    ]
    _check_unique(columns, where)
    _check_axes(columns, where)
    if robot is not None:
        _check_robot(columns, where, robot)
    return tuple(columns)


def _parse_column(heading: str, where: str, *, is_first: bool) -> FileColumn:
    match = _COLUMN.fullmatch(heading) or _COLUMN_IN_ROUND_BRACKETS.fullmatch(heading)
    if match is None:
        raise _make_heading_error(heading, where, is_first=is_first)
    name, unit_text = match[1].strip(BLANKS), match[2].strip(BLANKS)
    try:
        unit = parse_unit(unit_text)
    except UnitError as error:
        raise RecordError(
            "{where}: {name}: {error}", where=where, name=repr(name), error=str(error)
        ) from error
    if is_first != (name == "t"):
        raise RecordError(
            "{where}: heading {heading}; the first column, and only it, must be time: t [s]",
            where=where,
            heading=repr(heading),
        )
    channel = None if is_first else _parse_channel(name, where)
    _check_unit(channel, unit, where)
    return FileColumn(channel, unit)


def _make_heading_error(heading: str, where: str, *, is_first: bool) -> RecordError:
    template = message(
        "engine",
        "{where}: heading {heading} is not 'axis.channel [unit]'; write it like {example}",
    )
    if '"' in heading:
        template = message(
            "engine",
            "{where}: heading {heading} has an unpaired quote; write each heading on one line, "
            "like {example}",
        )
    elif is_first:
        template = message(
            "engine",
            "{where}: heading {heading} is not 'axis.channel [unit]'; write it like {example}, and "
            "begin lines above the header with '#'",
        )
    return RecordError(template.fill(where=where, heading=repr(heading), example=EXAMPLE_HEADER))


def _parse_channel(name: str, where: str) -> RecordChannel:
    axis, dot, tap = name.rpartition(".")
    axis, tap = (axis, tap) if dot else (name, Tap.CMD.value)
    if tap not in _TAPS:
        raise RecordError(
            "{where}: unknown channel {tap} in {name}; use one of {names}",
            where=where,
            tap=repr(tap),
            name=repr(name),
            names=" ".join(_TAPS),
        )
    check_axis_name(axis, where)
    return RecordChannel(axis, Tap(tap))


def check_axis_name(axis: str, where: str) -> None:
    """Refuse an axis name that a header cannot contain or a spreadsheet would take as a formula."""
    is_valid = _AXIS_NAME.fullmatch(axis) is not None and axis.isprintable()
    if not is_valid or len(axis) > _MAX_NAME_LENGTH:
        raise RecordError(
            "{where}: {axis} cannot name an axis; begin with a letter, and use no separators, "
            "brackets, quotes or '#' and at most {longest_name} characters",
            where=where,
            axis=repr(axis),
            longest_name=_MAX_NAME_LENGTH,
        )


def _check_unit(channel: RecordChannel | None, unit: str, where: str) -> None:
    allowed = ("s",) if channel is None else ("V",) if channel.tap in VOLTAGE_TAPS else ("m", "rad")
    if si_unit_of(unit) not in allowed:
        raise RecordError(
            "{where}: {value} cannot be in [{unit}]; use a unit of {names}",
            where=where,
            value=str(channel or "t"),
            unit=unit,
            names=FieldList(allowed, one_of_them=True),
        )


def _check_unique(columns: Sequence[FileColumn], where: str) -> None:
    first_numbers: dict[str, int] = {}
    for number, column in enumerate(columns, start=1):
        first_number = first_numbers.setdefault(str(column), number)
        if first_number != number:
            raise RecordError(
                "{where}:{number}: column {column} is already column {before}; remove one",
                where=where,
                number=number,
                column=str(column),
                before=first_number,
            )
    if len(columns) < 2:
        raise RecordError(
            "{where}: no column except time; add one, such as {example}",
            where=where,
            example=EXAMPLE_HEADER,
        )


def _check_axes(columns: Iterable[FileColumn], where: str) -> None:
    """Check that each axis has a command and the same quantity, length or angle, in all columns."""
    si_units: dict[str, str] = {}
    channel_columns = [column for column in columns if column.channel is not None]
    for number, column in enumerate(channel_columns, start=2):
        assert column.channel is not None
        axis, tap = column.channel
        if tap not in VOLTAGE_TAPS:
            si_unit = si_units.setdefault(axis, si_unit_of(column.unit))
            if si_unit != si_unit_of(column.unit):
                raise RecordError(
                    "{where}:{number}: {column} is in [{unit}], but an earlier column of "
                    "{axis} is in units of {kind}; correct one of them",
                    where=where,
                    number=number,
                    column=str(column),
                    unit=column.unit,
                    axis=repr(axis),
                    kind=si_unit,
                )
    check_commands([column.channel for column in channel_columns if column.channel], where)


def check_commands(channels: Iterable[RecordChannel], where: str) -> None:
    """Refuse an axis without a command, which is the only mandatory channel."""
    channels = tuple(channels)
    commanded_axes = {axis for axis, tap in channels if tap is Tap.CMD}
    for axis, tap in channels:
        if axis not in commanded_axes:
            raise RecordError(
                "{where}: axis {quoted} has {axis}.{tap} but no {axis}.cmd; add it",
                where=where,
                quoted=repr(axis),
                axis=axis,
                tap=tap,
            )


def _check_robot(columns: Iterable[FileColumn], where: str, robot: Robot) -> None:
    for number, column in enumerate(columns, start=1):
        if column.channel is None:
            continue
        axis, tap = column.channel
        if axis not in robot.axes:
            raise RecordError(
                "{where}:{number}: robot {name} has no axis {axis}; its axes are {names}",
                where=where,
                number=number,
                name=repr(robot.name),
                axis=repr(axis),
                names=" ".join(robot.axes),
            )
        si_unit = robot.unit(axis)
        if tap not in VOLTAGE_TAPS and si_unit is not None and si_unit_of(column.unit) != si_unit:
            raise RecordError(
                "{where}:{number}: {column} is in [{unit}] but robot {name} moves {axis} in "
                "units of {kind}; correct the unit",
                where=where,
                number=number,
                column=str(column),
                unit=column.unit,
                name=repr(robot.name),
                axis=repr(axis),
                kind=si_unit,
            )
