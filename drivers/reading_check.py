"""Plausibility of positions that a device reports: complete, in range, and reachable in time.

A driver puts every report through a :class:`ReadingCheck` before it uses it. What the check refuses
is discarded and counted; it never becomes the start of a move.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from math import isfinite

#: So many implausible reports in a row that agree with each other are a new position.
REPORTS_OF_A_NEW_POSITION = 3


@dataclass(frozen=True, slots=True)
class ReadingBounds:
    """What one axis may read, m or rad.

    Attributes
    ----------
    low, high : float
        Ends of the range.
    speed : float
        The greatest, m/s or rad/s.
    tolerance : float
        Rounding of reports; a reading may be so far outside, and so much farther from the last one.
    """

    low: float
    high: float
    speed: float
    tolerance: float


class ReadingCheck:
    """Decides which reported positions may be used.

    An axis whose position is unknown may read anything: its readings are for display only.

    Parameters
    ----------
    bounds : sequence of ReadingBounds
        One for each axis, in the order of the reports.
    """

    def __init__(self, bounds: Sequence[ReadingBounds]) -> None:
        self._bounds = tuple(bounds)
        self._position: tuple[float, ...] | None = None
        self._taken_s = 0.0
        # Reports refused in a row, each reachable from the one before, oldest first.
        self._run: list[tuple[float, tuple[float, ...]]] = []
        #: How many reports were refused so far.
        self.discarded = 0
        #: Whether the latest report was refused: nothing may begin to move meanwhile.
        self.is_in_doubt = False

    @property
    def shows_new_position(self) -> bool:
        """Whether so many refused reports agree that the axes must be elsewhere."""
        return len(self._run) >= REPORTS_OF_A_NEW_POSITION

    def restart(self, position: Sequence[float] | None = None, taken_s: float = 0.0) -> None:
        """Judge the next report from a position that is certain; without one, accept it anywhere.

        Parameters
        ----------
        position : sequence of float, optional
            Of each axis, m or rad.
        taken_s : float
            Host time at which the axes were there.
        """
        self._position = None if position is None else tuple(position)
        self._taken_s = taken_s
        self._run = []
        self.is_in_doubt = False

    def accepts(
        self,
        position: Sequence[float],
        asked_s: float,
        received_s: float,
        known_axes: Collection[int],
    ) -> bool:
        """Return whether a report may be used, and remember it.

        Parameters
        ----------
        position : sequence of float
            Of each axis, m or rad.
        asked_s, received_s : float
            Host times between which the device took it.
        known_axes : collection of int
            The axes whose position is known; the others are not judged.
        """
        report = tuple(position)
        if not self._is_complete(report):
            return self._refuse(None, received_s)
        last, elapsed_s = self._position, received_s - self._taken_s
        plausible = all(
            self._is_inside(axis, report[axis])
            and (last is None or self._is_reachable(axis, last[axis], report[axis], elapsed_s))
            for axis in known_axes
        )
        if not plausible:
            return self._refuse(report, received_s)
        self._position, self._taken_s = report, asked_s
        self._run = []
        self.is_in_doubt = False
        return True

    def _refuse(self, report: tuple[float, ...] | None, received_s: float) -> bool:
        self.discarded += 1
        self.is_in_doubt = True
        if report is None:
            return False
        if self._run:
            before_s, before = self._run[-1]
            agrees = all(
                self._is_reachable(axis, before[axis], report[axis], received_s - before_s)
                for axis in range(len(self._bounds))
            )
            self._run = self._run if agrees else []
        self._run.append((received_s, report))
        return False

    def _is_complete(self, report: tuple[float, ...]) -> bool:
        return len(report) == len(self._bounds) and all(map(isfinite, report))

    def _is_inside(self, axis: int, value: float) -> bool:
        bounds = self._bounds[axis]
        return bounds.low - bounds.tolerance <= value <= bounds.high + bounds.tolerance

    def _is_reachable(self, axis: int, start: float, end: float, elapsed_s: float) -> bool:
        bounds = self._bounds[axis]
        return abs(end - start) <= bounds.speed * max(elapsed_s, 0.0) + bounds.tolerance
