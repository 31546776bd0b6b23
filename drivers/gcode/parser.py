"""G-code words of the emulated controller: G0, G1, G20, G21, G53, G90, G91, F, axes."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

_WORD = re.compile(r"([A-Z])\s*([-+]?\d*\.?\d+)\s*")
_INCH = 25.4


class LineError(Exception):
    """What GRBL answers with ``error:N``."""

    def __init__(self, number: int) -> None:
        super().__init__(f"error:{number}")
        self.number = number


class Modes(Protocol):
    """What earlier lines have set."""

    absolute: bool
    rapid: bool
    scale: float
    feed: float


@dataclass(frozen=True, slots=True)
class Target:
    """Where a line leads, machine coordinates, mm or degrees, and how fast, per minute."""

    position: tuple[float, ...]
    feed: float


def jog_of(text: str, letters: str, start: Sequence[float]) -> Target:
    """Return what a jog, the part after ``$J=``, asks for; it changes no mode.

    Raises
    ------
    LineError
        If it is none.
    """
    absolute, scale, feed, at = True, 1.0, 0.0, dict[str, float]()
    for letter, value in _words(text):
        if letter == "G" and value in (20.0, 21.0):
            scale = _INCH if value == 20.0 else 1.0
        elif letter == "G" and value in (90.0, 91.0):
            absolute = value == 90.0
        elif letter == "F":
            feed = value
        elif letter in letters:
            at[letter] = value
        elif (letter, value) != ("G", 53.0):
            raise LineError(16)
    if feed <= 0.0:
        raise LineError(22)
    if not at:
        raise LineError(26)
    return _target(at, letters, start, absolute, scale, feed * scale)


def motion_of(line: str, letters: str, start: Sequence[float], modes: Modes) -> Target | None:
    """Return where a line of G-code leads, its modes noted; None where it leads nowhere.

    Raises
    ------
    LineError
        If it cannot be done.
    """
    at = dict[str, float]()
    for letter, value in _words(line):
        if letter == "G":
            _note(value, modes)
        elif letter == "F":
            modes.feed = value
        elif letter in letters:
            at[letter] = value
        else:
            raise LineError(20)
    if not at:
        return None
    if not modes.rapid and modes.feed <= 0.0:
        raise LineError(22)
    feed = float("inf") if modes.rapid else modes.feed * modes.scale
    return _target(at, letters, start, modes.absolute, modes.scale, feed)


def _note(value: float, modes: Modes) -> None:
    if value in (0.0, 1.0):
        modes.rapid = value == 0.0
    elif value in (20.0, 21.0):
        modes.scale = _INCH if value == 20.0 else 1.0
    elif value in (90.0, 91.0):
        modes.absolute = value == 90.0
    elif value not in (53.0, 94.0):
        raise LineError(20)


def _words(text: str) -> Iterator[tuple[str, float]]:
    at = 0
    text = text.strip()
    while at < len(text):
        found = _WORD.match(text, at)
        if found is None:
            raise LineError(2)
        yield found[1], float(found[2])
        at = found.end()


def _target(
    at: dict[str, float],
    letters: str,
    start: Sequence[float],
    absolute: bool,
    scale: float,
    feed: float,
) -> Target:
    position = list(start)
    for letter, value in at.items():
        number = letters.index(letter)
        position[number] = value * scale + (0.0 if absolute else start[number])
    return Target(tuple(position), feed)
