"""A path of moves and holds, row by row."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation.axis_draft import MAX_ROWS, AxisDraft
from rotemina.sim.excitation.moves import (
    compute_shortest_duration,
    count_rows,
    make_quintic,
    make_trapezoid,
)
from rotemina.sim.messages import format_rounded


class AxisPath:
    """Positions of one axis from ``start`` on, extended by moves from rest to rest.

    By default, ``acceleration`` is that of the draft. Every method raises ExcitationRequestError if
    there would be more than ``MAX_ROWS`` rows.
    """

    def __init__(self, draft: AxisDraft, start: float, acceleration: float | None = None) -> None:
        self._draft = draft
        self._acceleration = draft.acceleration if acceleration is None else acceleration
        self._parts: list[FloatArray] = [np.array([start])]
        self._rows = 1

    @property
    def values(self) -> FloatArray:
        """Positions (n,) so far, m or rad, including the start."""
        return np.concatenate(self._parts)

    @property
    def end(self) -> float:
        """The present position, m or rad."""
        return float(self._parts[-1][-1])

    def hold(self, duration_s: float) -> None:
        """Hold the present position for a time, rounded to rows."""
        self._check_row_limit(duration_s)
        self._add(np.full(round(duration_s * self._draft.rate_hz), self.end))

    def move(self, end: float, rows: int | None = None) -> None:
        """Move to ``end`` at the maximum acceleration, in ``rows`` or as fast as permitted."""
        rate_hz = self._draft.rate_hz
        if rows is None:
            stroke = abs(end - self.end)
            duration_s = compute_shortest_duration(stroke, self._draft.speed, self._acceleration)
            self._check_row_limit(duration_s)
            rows = count_rows(duration_s, rate_hz)
        self._check_row_limit(rows / rate_hz)
        self._add(make_trapezoid(self.end, end, rows, rate_hz, self._acceleration))

    def move_smoothly(self, end: float, duration_s: float) -> None:
        """Move to ``end`` by a minimum-jerk move of this duration, or up to a row longer."""
        self._check_row_limit(duration_s)
        self._add(make_quintic(self.end, end, count_rows(duration_s, self._draft.rate_hz)))

    def _add(self, positions: FloatArray) -> None:
        if len(positions):
            self._parts.append(positions)
            self._rows += len(positions)

    def _check_row_limit(self, duration_s: float) -> None:
        rate_hz = self._draft.rate_hz
        if not self._rows + duration_s * rate_hz <= MAX_ROWS:
            raise ExcitationRequestError(
                "axis {axis}: the excitation would take more than {most_rows} rows at {rate} "
                "Hz; shorten it, move faster or lower the rate",
                axis=self._draft.axis,
                most_rows=MAX_ROWS,
                rate=format_rounded(rate_hz, 6),
            )
