"""The last check before a line goes to a controller: no target outside an axis' range."""

import re
from collections.abc import Mapping
from types import MappingProxyType

from rotemina.drivers.errors import LimitError
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed

_JOG = "$J="
# Absolute machine coordinates in mm: the only kind of target whose end can be checked.
_MODES = frozenset({"G53", "G21", "G90"})
_WORD = re.compile(r"([A-Z])(-?\d+(?:\.\d+)?)")
# Lines that move nothing, and searches for switches.
_HARMLESS = re.compile(r"\$(\$|I|X|H[A-Z]?|/[\w/]+)")
# Targets have four decimals.
_ROUNDING = 1e-4


class JogGuard:
    """Refuses every line that could move an axis out of its range.

    It knows nothing of readings: what was read wrongly cannot widen it.
    """

    def __init__(self) -> None:
        self._ranges: Mapping[str, tuple[float, float]] = MappingProxyType({})

    def permit_ranges(self, ranges: Mapping[str, tuple[float, float]]) -> None:
        """Permit targets of these axes, by letter, in the controller's coordinates."""
        self._ranges = MappingProxyType(dict(ranges))

    def check(self, line: str) -> None:
        """Refuse a line that must not be sent.

        Raises
        ------
        LimitError
            With the line and the bound.
        """
        if line.startswith(_JOG):
            self._check_jog(line)
        elif not _HARMLESS.fullmatch(line):
            raise self._refusal(line, message("engine", "it is no line that this driver sends"))

    def _check_jog(self, line: str) -> None:
        words = line.removeprefix(_JOG).split()
        missing = _MODES.difference(words)
        if missing:
            raise self._refusal(
                line, message("engine", "{modes} is missing").fill(modes=", ".join(sorted(missing)))
            )
        for word in words:
            if word not in _MODES:
                self._check_word(line, word)

    def _check_word(self, line: str, word: str) -> None:
        match = _WORD.fullmatch(word)
        if match is None:
            raise self._refusal(line, message("engine", "{word} is no word").fill(word=repr(word)))
        letter, value = match[1], float(match[2])
        if letter == "F":
            return
        if letter not in self._ranges:
            raise self._refusal(
                line, message("engine", "no axis {letter} is known").fill(letter=letter)
            )
        low, high = self._ranges[letter]
        if not low - _ROUNDING <= value <= high + _ROUNDING:
            raise self._refusal(
                line,
                message("engine", "{letter} must be {low} to {high}").fill(
                    letter=letter, low=fixed(low, 3), high=fixed(high, 3)
                ),
            )

    def _refusal(self, line: str, why: str) -> LimitError:
        return LimitError(
            message("engine", "gcode: {line} was not sent: {why}").fill(line=repr(line), why=why)
        )
