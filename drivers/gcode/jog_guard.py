"""Last check before a line is sent to a controller: every target is in the range of its axis."""

import re
from collections.abc import Mapping
from types import MappingProxyType

from rotemina.drivers.contract import LimitError
from rotemina.sim.messages import format_fixed, message

_JOG_PREFIX = "$J="
# Absolute machine coordinates in mm. Targets in other modes cannot be checked.
_REQUIRED_MODES = frozenset({"G53", "G21", "G90"})
_WORD_PATTERN = re.compile(r"([A-Z])(-?\d+(?:\.\d+)?)")
# Besides jogs, the driver sends lines that move nothing, and homing.
_ALLOWED_PATTERN = re.compile(r"\$(\$|I|X|H[A-Z]?|/[\w/]+)")
# Targets have four decimals, in mm or degrees.
_TARGET_ROUNDING = 1e-4


class JogGuard:
    """Guard that refuses every line that could move an axis out of its range.

    It does not depend on readings, so a wrong reading cannot widen a range.
    """

    def __init__(self) -> None:
        self._ranges: Mapping[str, tuple[float, float]] = MappingProxyType({})

    def permit_ranges(self, ranges: Mapping[str, tuple[float, float]]) -> None:
        """Set the permitted range of targets of each axis, by letter, in controller coordinates."""
        self._ranges = MappingProxyType(dict(ranges))

    def check(self, line: str) -> None:
        """Raise if a line must not be sent.

        Raises
        ------
        LimitError
            If the line must not be sent. The message states the line and the reason.
        """
        if line.startswith(_JOG_PREFIX):
            self._check_jog(line)
        elif not _ALLOWED_PATTERN.fullmatch(line):
            raise self._make_refusal(line, message("engine", "this driver never sends such a line"))

    def _check_jog(self, line: str) -> None:
        words = line.removeprefix(_JOG_PREFIX).split()
        missing = _REQUIRED_MODES.difference(words)
        if missing:
            raise self._make_refusal(
                line, message("engine", "{modes} is missing").fill(modes=", ".join(sorted(missing)))
            )
        for word in words:
            if word not in _REQUIRED_MODES:
                self._check_word(line, word)

    def _check_word(self, line: str, word: str) -> None:
        match = _WORD_PATTERN.fullmatch(word)
        if match is None:
            raise self._make_refusal(
                line, message("engine", "{word} is not a valid word").fill(word=repr(word))
            )
        letter, value = match[1], float(match[2])
        if letter == "F":
            return
        if letter not in self._ranges:
            raise self._make_refusal(
                line, message("engine", "unknown axis {letter}").fill(letter=letter)
            )
        low, high = self._ranges[letter]
        if not low - _TARGET_ROUNDING <= value <= high + _TARGET_ROUNDING:
            raise self._make_refusal(
                line,
                message("engine", "{letter} must be {low} to {high}").fill(
                    letter=letter, low=format_fixed(low, 3), high=format_fixed(high, 3)
                ),
            )

    def _make_refusal(self, line: str, reason: str) -> LimitError:
        return LimitError("gcode: {line} was not sent: {why}", line=repr(line), why=reason)
