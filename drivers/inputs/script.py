"""A script: the motion of an input device over time, in Python or a CSV file."""

import csv
from dataclasses import dataclass
from io import StringIO
from math import isfinite
from pathlib import Path
from typing import Self

from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.input_files import read_text
from rotemina.sim.messages import marked, message

_MOST_BYTES = 16_000_000
_TIME, _PLUGGED, _AXIS, _BUTTON = "time_s", "plugged", "axis ", "button "


class ScriptError(InputError):
    """A script of an input device that cannot be played."""


@dataclass(frozen=True, slots=True)
class Moment:
    """The device's state from ``time_s`` on; unreadable while not ``plugged``."""

    time_s: float
    axes: tuple[float, ...]
    buttons: tuple[bool, ...] = ()
    plugged: bool = True


@dataclass(frozen=True, slots=True)
class Script:
    """What a device does: names of axes and buttons, and moments in the order of time.

    Raises
    ------
    ScriptError
        If times do not increase, or a moment has other axes and buttons than the script, or a
        deflection beyond −1 to 1.
    """

    axes: tuple[str, ...]
    buttons: tuple[str, ...]
    moments: tuple[Moment, ...]

    def __post_init__(self) -> None:
        before = float("-inf")
        for number, moment in enumerate(self.moments, 1):
            where = message("engine", "moment {number}").fill(number=number)
            if not isfinite(moment.time_s) or moment.time_s <= before:
                raise ScriptError(
                    message(
                        "engine",
                        "{where}: time {time_s} s: must be later than the one before ({before} s)",
                    ).fill(where=where, time_s=moment.time_s, before=before)
                )
            before = moment.time_s
            if (len(moment.axes), len(moment.buttons)) != (len(self.axes), len(self.buttons)):
                raise ScriptError(
                    message(
                        "engine",
                        "{where}: {axes} axes and {buttons} buttons: must be {axes_wanted} and "
                        "{buttons_wanted}",
                    ).fill(
                        where=where,
                        axes=len(moment.axes),
                        buttons=len(moment.buttons),
                        axes_wanted=len(self.axes),
                        buttons_wanted=len(self.buttons),
                    )
                )
            for name, deflection in zip(self.axes, moment.axes, strict=True):
                if not -1.0 <= deflection <= 1.0:
                    raise ScriptError(
                        message("engine", "{where}: {name} at {deflection}: must be -1 to 1").fill(
                            where=where, name=name, deflection=deflection
                        )
                    )

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read a CSV file: ``time_s``, ``axis NAME``…, ``button NAME``…, ``plugged`` (0 or 1).

        Raises
        ------
        ScriptError
            With file, line and column.
        """
        text = read_text(path, ScriptError, _MOST_BYTES, advice=marked("engine", "name a CSV file"))
        try:
            reader = csv.reader(StringIO(text, newline=""))
            columns = [name.strip() for name in next(reader, [])]
            _check(path, columns)
            moments = tuple(
                _moment(f"{path}, line {reader.line_num}", columns, row) for row in reader if row
            )
        except csv.Error as error:
            raise ScriptError(
                message("engine", "{path}: cannot be read: {error}").fill(
                    path=path, error=reason_of(error)
                )
            ) from error
        try:
            return cls(_named(columns, _AXIS), _named(columns, _BUTTON), moments)
        except ScriptError as error:
            raise ScriptError(
                message("engine", "{path}: {error}").fill(path=path, error=reason_of(error))
            ) from error


def _named(columns: list[str], kind: str) -> tuple[str, ...]:
    return tuple(name.removeprefix(kind) for name in columns if name.startswith(kind))


def _check(path: Path, columns: list[str]) -> None:
    """Refuse columns that mean nothing, or the same twice."""
    if _TIME not in columns:
        raise ScriptError(
            message("engine", "{path}, line 1: column {time} is missing").fill(
                path=path, time=repr(_TIME)
            )
        )
    for name in columns:
        if name not in (_TIME, _PLUGGED) and not name.startswith((_AXIS, _BUTTON)):
            raise ScriptError(
                message(
                    "engine",
                    "{path}, line 1: unknown column {name}; permitted are {time}, {plugged}, "
                    "'axis NAME' and 'button NAME'",
                ).fill(path=path, name=repr(name), time=repr(_TIME), plugged=repr(_PLUGGED))
            )
        if columns.count(name) > 1:
            raise ScriptError(
                message("engine", "{path}, line 1: column {name} appears twice").fill(
                    path=path, name=repr(name)
                )
            )


def _moment(where: str, columns: list[str], row: list[str]) -> Moment:
    """Return what a line says, in the order of the columns."""
    if len(row) != len(columns):
        raise ScriptError(
            message("engine", "{where}: {count} values: must be {columns}, as in line 1").fill(
                where=where, count=len(row), columns=len(columns)
            )
        )
    values = {name: _number(where, name, text) for name, text in zip(columns, row, strict=True)}
    return Moment(
        values[_TIME],
        tuple(value for name, value in values.items() if name.startswith(_AXIS)),
        tuple(value == 1.0 for name, value in values.items() if name.startswith(_BUTTON)),
        values.get(_PLUGGED, 1.0) == 1.0,
    )


def _number(where: str, column: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError as error:
        raise ScriptError(
            message("engine", "{where}, column {column}: {strip} is not a number").fill(
                where=where, column=repr(column), strip=repr(text.strip())
            )
        ) from error
    if (column == _PLUGGED or column.startswith(_BUTTON)) and value not in (0.0, 1.0):
        raise ScriptError(
            message("engine", "{where}, column {column}: {value}: must be 0 or 1").fill(
                where=where, column=repr(column), value=value
            )
        )
    return value
