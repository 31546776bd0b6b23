"""A script of an input device's motion over time, from Python or a CSV file."""

import csv
from dataclasses import dataclass
from io import StringIO
from math import isfinite
from pathlib import Path
from typing import Self

from rotemina.drivers.contract import ScriptError
from rotemina.sim.errors import describe_exception
from rotemina.sim.files import read_text
from rotemina.sim.messages import marked, message

_MAX_FILE_BYTES = 16_000_000
_TIME_COLUMN, _PLUGGED_COLUMN, _AXIS_PREFIX, _BUTTON_PREFIX = (
    "time_s",
    "plugged",
    "axis ",
    "button ",
)


@dataclass(frozen=True, slots=True)
class ScriptMoment:
    """State of the device from ``time_s`` on; ``plugged`` is False while it is unplugged."""

    time_s: float
    axes: tuple[float, ...]
    buttons: tuple[bool, ...] = ()
    plugged: bool = True


@dataclass(frozen=True, slots=True)
class InputScript:
    """Script of a device: names of its axes and buttons, and moments in the order of time.

    Raises
    ------
    ScriptError
        If the times do not increase, a moment has a different number of axes or buttons than the
        script, or a deflection is not within −1 to 1.
    """

    axes: tuple[str, ...]
    buttons: tuple[str, ...]
    moments: tuple[ScriptMoment, ...]

    def __post_init__(self) -> None:
        previous_s = float("-inf")
        for number, moment in enumerate(self.moments, 1):
            where = message("engine", "moment {number}").fill(number=number)
            if not isfinite(moment.time_s) or moment.time_s <= previous_s:
                raise ScriptError(
                    "{where}: time {time_s} s: must be later than the previous one ({before} s)",
                    where=where,
                    time_s=moment.time_s,
                    before=previous_s,
                )
            previous_s = moment.time_s
            if (len(moment.axes), len(moment.buttons)) != (len(self.axes), len(self.buttons)):
                raise ScriptError(
                    "{where}: {axes} axes and {buttons} buttons: must be {axes_wanted} and "
                    "{buttons_wanted}",
                    where=where,
                    axes=len(moment.axes),
                    buttons=len(moment.buttons),
                    axes_wanted=len(self.axes),
                    buttons_wanted=len(self.buttons),
                )
            for name, deflection in zip(self.axes, moment.axes, strict=True):
                if not -1.0 <= deflection <= 1.0:
                    raise ScriptError(
                        "{where}: {name} at {deflection}: must be -1 to 1",
                        where=where,
                        name=name,
                        deflection=deflection,
                    )

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read a CSV file: ``time_s``, ``axis NAME``…, ``button NAME``…, ``plugged`` (0 or 1).

        Raises
        ------
        ScriptError
            If the file is invalid; the message contains file, line and column.
        """
        text = read_text(
            path, ScriptError, _MAX_FILE_BYTES, advice=marked("engine", "name a CSV file")
        )
        try:
            reader = csv.reader(StringIO(text, newline=""))
            columns = [name.strip() for name in next(reader, [])]
            _check_columns(path, columns)
            moments = tuple(
                _parse_moment(f"{path}, line {reader.line_num}", columns, row)
                for row in reader
                if row
            )
        except csv.Error as error:
            raise ScriptError(
                "{path}: cannot be read: {error}", path=path, error=describe_exception(error)
            ) from error
        try:
            return cls(
                _select_names(columns, _AXIS_PREFIX),
                _select_names(columns, _BUTTON_PREFIX),
                moments,
            )
        except ScriptError as error:
            raise ScriptError(
                "{path}: {error}", path=path, error=describe_exception(error)
            ) from error


def _select_names(columns: list[str], prefix: str) -> tuple[str, ...]:
    return tuple(name.removeprefix(prefix) for name in columns if name.startswith(prefix))


def _check_columns(path: Path, columns: list[str]) -> None:
    """Raise :class:`ScriptError` if a column is unknown, missing or duplicated."""
    if _TIME_COLUMN not in columns:
        raise ScriptError(
            "{path}, line 1: column {time} is missing", path=path, time=repr(_TIME_COLUMN)
        )
    for name in columns:
        if name not in (_TIME_COLUMN, _PLUGGED_COLUMN) and not name.startswith(
            (_AXIS_PREFIX, _BUTTON_PREFIX)
        ):
            raise ScriptError(
                "{path}, line 1: unknown column {name}; permitted are {time}, {plugged}, "
                "'axis NAME' and 'button NAME'",
                path=path,
                name=repr(name),
                time=repr(_TIME_COLUMN),
                plugged=repr(_PLUGGED_COLUMN),
            )
        if columns.count(name) > 1:
            raise ScriptError(
                "{path}, line 1: column {name} appears twice", path=path, name=repr(name)
            )


def _parse_moment(where: str, columns: list[str], row: list[str]) -> ScriptMoment:
    if len(row) != len(columns):
        raise ScriptError(
            "{where}: {count} values: must be {columns}, as in line 1",
            where=where,
            count=len(row),
            columns=len(columns),
        )
    values = {
        name: _parse_number(where, name, text) for name, text in zip(columns, row, strict=True)
    }
    return ScriptMoment(
        values[_TIME_COLUMN],
        tuple(value for name, value in values.items() if name.startswith(_AXIS_PREFIX)),
        tuple(value == 1.0 for name, value in values.items() if name.startswith(_BUTTON_PREFIX)),
        values.get(_PLUGGED_COLUMN, 1.0) == 1.0,
    )


def _parse_number(where: str, column: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError as error:
        raise ScriptError(
            "{where}, column {column}: {strip} is not a number",
            where=where,
            column=repr(column),
            strip=repr(text.strip()),
        ) from error
    if (column == _PLUGGED_COLUMN or column.startswith(_BUTTON_PREFIX)) and value not in (0.0, 1.0):
        raise ScriptError(
            "{where}, column {column}: {value}: must be 0 or 1",
            where=where,
            column=repr(column),
            value=value,
        )
    return value
