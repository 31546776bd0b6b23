"""G-code parser of the emulated controller: G0, G1, G20, G21, G53, G90, G91, F, axis words."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

_WORD_PATTERN = re.compile(r"([A-Z])\s*([-+]?\d*\.?\d+)\s*")
_MM_PER_INCH = 25.4


class LineError(Exception):
    """An error that GRBL reports as ``error:N``."""

    def __init__(self, number: int) -> None:
        super().__init__(f"error:{number}")
        self.number = number


class ModalState(Protocol):
    """Modal state: the modes that earlier lines have set.

    ``scale`` is in mm per programmed unit, and ``feed`` in programmed units per minute.
    """

    absolute: bool
    rapid: bool
    scale: float
    feed: float


@dataclass(frozen=True, slots=True)
class LineTarget:
    """Target of a line, in machine coordinates, mm or degrees, and its feed rate per minute."""

    position: tuple[float, ...]
    feed: float


def parse_jog(text: str, letters: str, start: Sequence[float]) -> LineTarget:
    """Parse a jog, given the part of the line after ``$J=``. A jog changes no mode.

    Raises
    ------
    LineError
        If the text is not a valid jog.
    """
    absolute, scale, feed, coordinates = True, 1.0, 0.0, dict[str, float]()
    for letter, value in _split_words(text):
        if letter == "G" and value in (20.0, 21.0):
            scale = _MM_PER_INCH if value == 20.0 else 1.0
        elif letter == "G" and value in (90.0, 91.0):
            absolute = value == 90.0
        elif letter == "F":
            feed = value
        elif letter in letters:
            coordinates[letter] = value
        elif (letter, value) != ("G", 53.0):
            raise LineError(16)
    if feed <= 0.0:
        raise LineError(22)
    if not coordinates:
        raise LineError(26)
    return _make_target(coordinates, letters, start, absolute, scale, feed * scale)


def parse_motion(
    line: str, letters: str, start: Sequence[float], modes: ModalState
) -> LineTarget | None:
    """Parse a line of G-code and update the modes; return None if it has no target.

    Raises
    ------
    LineError
        If the line is not valid or not supported.
    """
    coordinates = dict[str, float]()
    for letter, value in _split_words(line):
        if letter == "G":
            _apply_mode(value, modes)
        elif letter == "F":
            modes.feed = value
        elif letter in letters:
            coordinates[letter] = value
        else:
            raise LineError(20)
    if not coordinates:
        return None
    if not modes.rapid and modes.feed <= 0.0:
        raise LineError(22)
    feed = float("inf") if modes.rapid else modes.feed * modes.scale
    return _make_target(coordinates, letters, start, modes.absolute, modes.scale, feed)


def _apply_mode(value: float, modes: ModalState) -> None:
    if value in (0.0, 1.0):
        modes.rapid = value == 0.0
    elif value in (20.0, 21.0):
        modes.scale = _MM_PER_INCH if value == 20.0 else 1.0
    elif value in (90.0, 91.0):
        modes.absolute = value == 90.0
    elif value not in (53.0, 94.0):
        raise LineError(20)


def _split_words(text: str) -> Iterator[tuple[str, float]]:
    position = 0
    text = text.strip()
    while position < len(text):
        match = _WORD_PATTERN.match(text, position)
        if match is None:
            raise LineError(2)
        yield match[1], float(match[2])
        position = match.end()


def _make_target(
    coordinates: dict[str, float],
    letters: str,
    start: Sequence[float],
    absolute: bool,
    scale: float,
    feed: float,
) -> LineTarget:
    position = list(start)
    for letter, value in coordinates.items():
        number = letters.index(letter)
        position[number] = value * scale + (0.0 if absolute else start[number])
    return LineTarget(tuple(position), feed)
