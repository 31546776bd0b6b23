"""Reports of a GRBL controller: each line as a message.

Source: GRBL 1.1 (``interface.md``), grblHAL (``report.c``), FluidNC (``Report.cpp``).
"""

import re
from dataclasses import dataclass
from math import isfinite

_STATUS = re.compile(r"<(\w*)(?::(\d+))?\|([^<>]*)>")
_NUMBERED = re.compile(r"(error|ALARM):(\d+)")
_SETTING = re.compile(r"\$([\w/]+)=(.*)")
_COORDINATE = re.compile(r"[+-]?\d+(\.\d*)?")
#: The note of a controller that is a program; it adds that to its build info ($I).
VIRTUAL = "MACHINE:virtual"
#: The older form of a status, of GRBL 0.9 and before: commas where 1.1 has bars.
OLD_STATUS = re.compile(r"<\w+,[MW]Pos:")


@dataclass(frozen=True, slots=True)
class Status:
    """``<State:substate|MPos:x,y,z|…>``.

    Attributes
    ----------
    state : str
    substate : int or None
    position : tuple of float or None
        The machine position, mm or degrees; None where the report has none that can be read.
    """

    state: str
    substate: int | None
    position: tuple[float, ...] | None


@dataclass(frozen=True, slots=True)
class Answer:
    """``ok``, or ``error:N``."""

    error: int | None = None


@dataclass(frozen=True, slots=True)
class Alarm:
    """``ALARM:N``: the controller has locked itself."""

    number: int


@dataclass(frozen=True, slots=True)
class Welcome:
    """The greeting after each reset."""

    text: str


@dataclass(frozen=True, slots=True)
class Setting:
    """``$name=text``; names are numbers, in FluidNC also paths, and not every text is a number."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class Note:
    """``[…]``: a message, or what the controller was built with."""

    text: str


Message = Status | Answer | Alarm | Welcome | Setting | Note


def parse_report(line: str) -> Message | None:
    """Return the message of a line; None if it is not a controller's."""
    if line == "ok":
        return Answer()
    if line.lower().startswith("grbl"):
        return Welcome(line)
    if line.startswith("[") and line.endswith("]"):
        return Note(line[1:-1])
    if match := _NUMBERED.fullmatch(line):
        number = int(match[2])
        return Answer(number) if match[1] == "error" else Alarm(number)
    if match := _STATUS.fullmatch(line):
        substate = int(match[2]) if match[2] else None
        return Status(match[1], substate, _read_position(match[3]))
    if match := _SETTING.fullmatch(line):
        return Setting(match[1], match[2])
    return None


def read_number(text: str) -> float | None:
    """Return the number that a setting begins with, as ``10.000 (x, mm)``; None where none is."""
    words = text.split()
    try:
        value = float(words[0]) if words else float("nan")
    except ValueError:
        return None
    return value if isfinite(value) else None


def _read_position(fields: str) -> tuple[float, ...] | None:
    for field in fields.split("|"):
        name, _, numbers = field.partition(":")
        if name == "MPos":
            coordinates = numbers.split(",")
            if all(map(_COORDINATE.fullmatch, coordinates)):
                return tuple(map(float, coordinates))
    return None
