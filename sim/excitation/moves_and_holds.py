"""A path of moves and holds, row by row."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.excitation.axis_draft import MOST_ROWS, Draft
from rotemina.sim.excitation.moves import (
    quintic,
    rows_of,
    shortest_duration,
    trapezoid,
)
from rotemina.sim.excitation.quantity import ExcitationError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded


class Path:
    """Positions of one axis, begun at ``start`` and grown by moves from rest to rest.

    ``acceleration`` is the draft's if not given. Every method raises ExcitationError where there
    would be more than ``MOST_ROWS`` rows.
    """

    def __init__(self, draft: Draft, start: float, acceleration: float | None = None) -> None:
        self._draft = draft
        self._acceleration = draft.acceleration if acceleration is None else acceleration
        self._parts: list[FloatArray] = [np.array([start])]
        self._rows = 1

    @property
    def values(self) -> FloatArray:
        """Positions (n,) so far, m or rad, the start included."""
        return np.concatenate(self._parts)

    @property
    def end(self) -> float:
        """Where it is now, m or rad."""
        return float(self._parts[-1][-1])

    def hold(self, duration_s: float) -> None:
        """Rest for a time, rounded to rows."""
        self._check_room(duration_s)
        self._add(np.full(round(duration_s * self._draft.rate_hz), self.end))

    def move(self, end: float, rows: int | None = None) -> None:
        """Go to ``end`` at the greatest acceleration, in ``rows`` or as fast as allowed."""
        rate = self._draft.rate_hz
        if rows is None:
            stroke = abs(end - self.end)
            duration = shortest_duration(stroke, self._draft.speed, self._acceleration)
            self._check_room(duration)
            rows = rows_of(duration, rate)
        self._check_room(rows / rate)
        self._add(trapezoid(self.end, end, rows, rate, self._acceleration))

    def curve(self, end: float, duration_s: float) -> None:
        """Go to ``end`` by a minimum-jerk move of this time, or up to a row more."""
        self._check_room(duration_s)
        self._add(quintic(self.end, end, rows_of(duration_s, self._draft.rate_hz)))

    def _add(self, part: FloatArray) -> None:
        if len(part):
            self._parts.append(part)
            self._rows += len(part)

    def _check_room(self, duration_s: float) -> None:
        rate = self._draft.rate_hz
        if not self._rows + duration_s * rate <= MOST_ROWS:
            raise ExcitationError(
                message(
                    "engine",
                    "axis {axis}: it would take more than {most_rows} rows at {rate} Hz; shorten "
                    "it, move faster or lower the rate",
                ).fill(axis=self._draft.axis, most_rows=MOST_ROWS, rate=rounded(rate, 6))
            )
