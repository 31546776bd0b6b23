"""Check whether positions that a device reports are complete, in range, and reachable in time.

A driver passes every report to a :class:`ReadingCheck` before use. A report that the check refuses
is discarded and counted, and never becomes the start of a move.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from math import isfinite

#: This many refused reports in a row that agree with each other show a new position.
NEW_POSITION_REPORT_COUNT = 3


@dataclass(frozen=True, slots=True)
class ReadingBounds:
    """Plausible readings of one axis, m or rad.

    Attributes
    ----------
    low, high : float
        Ends of the range.
    speed : float
        Maximum speed, m/s or rad/s.
    tolerance : float
        Rounding error of a report, by which the range and the reachable distance are extended.
    """

    low: float
    high: float
    speed: float
    tolerance: float


class ReadingCheck:
    """Decides which reported positions may be used.

    For an axis whose position is unknown, any reading is accepted, because it is only displayed.

    Parameters
    ----------
    bounds : sequence of ReadingBounds
        One for each axis, in the order of the reports.
    """

    def __init__(self, bounds: Sequence[ReadingBounds]) -> None:
        self._bounds = tuple(bounds)
        # The latest accepted position, and the host time at which it was measured at the earliest.
        self._position: tuple[float, ...] | None = None
        self._measured_s = 0.0
        # The latest refused reports with their times, each reachable from the one before.
        self._refused_reports: list[tuple[float, tuple[float, ...]]] = []
        #: Total number of refused reports.
        self.discarded_count = 0
        #: Whether the latest report was refused. Then no motion may start.
        self.is_in_doubt = False

    @property
    def shows_new_position(self) -> bool:
        """Whether enough refused reports agree on another position of the axes."""
        return len(self._refused_reports) >= NEW_POSITION_REPORT_COUNT

    def restart(self, position: Sequence[float] | None = None, taken_s: float = 0.0) -> None:
        """Set the position with which the next report is compared.

        Parameters
        ----------
        position : sequence of float, optional
            Position of each axis, m or rad. If it is None, any position in range is accepted.
        taken_s : float
            Host time at which the axes were at ``position``.
        """
        self._position = None if position is None else tuple(position)
        self._measured_s = taken_s
        self._refused_reports = []
        self.is_in_doubt = False

    def accept_report(
        self,
        position: Sequence[float],
        requested_s: float,
        received_s: float,
        known_axes: Collection[int],
    ) -> bool:
        """Check a report, remember it, and return whether it may be used.

        Parameters
        ----------
        position : sequence of float
            Position of each axis, m or rad.
        requested_s, received_s : float
            Host times between which the device measured the position.
        known_axes : collection of int
            Indices of the axes whose position is known; the others are not checked.
        """
        report = tuple(position)
        if not self._is_complete(report):
            return self._refuse(None, received_s)
        last, elapsed_s = self._position, received_s - self._measured_s
        is_plausible = all(
            self._is_in_range(axis, report[axis])
            and (last is None or self._is_reachable(axis, last[axis], report[axis], elapsed_s))
            for axis in known_axes
        )
        if not is_plausible:
            return self._refuse(report, received_s)
        self._position, self._measured_s = report, requested_s
        self._refused_reports = []
        self.is_in_doubt = False
        return True

    def _refuse(self, report: tuple[float, ...] | None, received_s: float) -> bool:
        self.discarded_count += 1
        self.is_in_doubt = True
        if report is None:
            return False
        if self._refused_reports:
            previous_s, previous_report = self._refused_reports[-1]
            agrees = all(
                self._is_reachable(
                    axis, previous_report[axis], report[axis], received_s - previous_s
                )
                for axis in range(len(self._bounds))
            )
            self._refused_reports = self._refused_reports if agrees else []
        self._refused_reports.append((received_s, report))
        return False

    def _is_complete(self, report: tuple[float, ...]) -> bool:
        return len(report) == len(self._bounds) and all(map(isfinite, report))

    def _is_in_range(self, axis: int, value: float) -> bool:
        bounds = self._bounds[axis]
        return bounds.low - bounds.tolerance <= value <= bounds.high + bounds.tolerance

    def _is_reachable(self, axis: int, start: float, end: float, elapsed_s: float) -> bool:
        bounds = self._bounds[axis]
        return abs(end - start) <= bounds.speed * max(elapsed_s, 0.0) + bounds.tolerance
