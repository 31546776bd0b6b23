"""Parser for the reports of a GRBL controller. Each line becomes a message.

Source: GRBL 1.1 (``interface.md``), grblHAL (``report.c``), FluidNC (``Report.cpp``).
"""

import re
from dataclasses import dataclass
from math import isfinite

_STATUS_PATTERN = re.compile(r"<(\w*)(?::(\d+))?\|([^<>]*)>")
_NUMBERED_PATTERN = re.compile(r"(error|ALARM):(\d+)")
_SETTING_PATTERN = re.compile(r"\$([\w/]+)=(.*)")
_COORDINATE_PATTERN = re.compile(r"[+-]?\d+(\.\d*)?")
#: An emulated controller sends this note in its build info ($I).
VIRTUAL_NOTE = "MACHINE:virtual"
#: Beginning of a status report of GRBL 0.9 or older, which has commas instead of bars.
OLD_STATUS_PATTERN = re.compile(r"<\w+,[MW]Pos:")


@dataclass(frozen=True, slots=True)
class StatusReport:
    """A status report, ``<State:substate|MPos:x,y,z|…>``.

    Attributes
    ----------
    state : str
    substate : int or None
    position : tuple of float or None
        Machine position, mm or degrees; None if it is missing or unreadable.
    """

    state: str
    substate: int | None
    position: tuple[float, ...] | None


@dataclass(frozen=True, slots=True)
class LineAnswer:
    """The answer to a line, ``ok`` or ``error:N``."""

    error: int | None = None


@dataclass(frozen=True, slots=True)
class AlarmReport:
    """``ALARM:N``: the controller has locked itself."""

    number: int


@dataclass(frozen=True, slots=True)
class WelcomeMessage:
    """The greeting after each reset."""

    text: str


@dataclass(frozen=True, slots=True)
class SettingReport:
    """A setting, ``$name=text``. A name is a number or, in FluidNC, a path."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class NoteMessage:
    """A note, ``[…]``: a message or a build option."""

    text: str


ControllerMessage = (
    StatusReport | LineAnswer | AlarmReport | WelcomeMessage | SettingReport | NoteMessage
)


def parse_report(line: str) -> ControllerMessage | None:
    """Parse a line; return None if it is not a message of a controller."""
    if line == "ok":
        return LineAnswer()
    if line.lower().startswith("grbl"):
        return WelcomeMessage(line)
    if line.startswith("[") and line.endswith("]"):
        return NoteMessage(line[1:-1])
    if match := _NUMBERED_PATTERN.fullmatch(line):
        number = int(match[2])
        return LineAnswer(number) if match[1] == "error" else AlarmReport(number)
    if match := _STATUS_PATTERN.fullmatch(line):
        substate = int(match[2]) if match[2] else None
        return StatusReport(match[1], substate, _parse_position(match[3]))
    if match := _SETTING_PATTERN.fullmatch(line):
        return SettingReport(match[1], match[2])
    return None


def parse_number(text: str) -> float | None:
    """Return the number at the beginning of a setting such as ``10.000 (x, mm)``, or None."""
    words = text.split()
    try:
        value = float(words[0]) if words else float("nan")
    except ValueError:
        return None
    return value if isfinite(value) else None


def _parse_position(fields: str) -> tuple[float, ...] | None:
    for field in fields.split("|"):
        name, _, numbers = field.partition(":")
        if name == "MPos":
            coordinates = numbers.split(",")
            if all(map(_COORDINATE_PATTERN.fullmatch, coordinates)):
                return tuple(map(float, coordinates))
    return None
