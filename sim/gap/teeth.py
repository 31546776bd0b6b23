"""Where the steps of a coarse converter lie: how wide they are, and where one begins.

From one end of a travel to the other there may be thousands. No fit finds them downhill, but what
they leave over position is a sawtooth: its line in the spectrum tells the width well enough for
the record with the fewest teeth, that record tells it well enough for the next one, and so on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import Fit
from rotemina.sim.gap.lines import strongest_periods
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect

_SHIFTS = 12
_WIDTHS = 5  # on the first record
_OFF = 0.25  # of a tooth, that the line may be off at the ends of a record
_FINE = 12  # parts of a tooth, to which the next record is matched
_PARTS = (0.04, 0.02, 0.008, 0.003, 0.001)  # of a tooth, by which a grid is moved at last
_MOST = 120  # widths that are tried on a further record
_PROMISES = 0.15  # of what is left of a record, that a sawtooth takes away at once
_CLOSES = 0.25  # the same, filtered by the mechanics
_PERIODS = 2  # lines that are looked at


def likeliest_grid(
    evidence: Evidence,
    fitted: Fit,
    candidate: AxisEffect,
    bounds: tuple[float, float],
    origin: float,
    gain: float,
) -> dict[str, float] | None:
    """Return step and shift of a quantization; None where no record shows teeth.

    Parameters
    ----------
    bounds : tuple of float
        Of the width of a step, m or rad.
    origin : float
        Where the grid is counted from, m or rad.
    gain : float
        Of the step's own unit to m or rad.
    """
    search = _Search(evidence, fitted, candidate, bounds, origin, gain)
    for period in list(dict.fromkeys(strongest_periods(evidence, fitted, bounds)))[:_PERIODS]:
        for record in search.clearest(period):
            found = search.matched(record, period)
            if found is not None:
                return found
    return None


class _Search:
    def __init__(
        self,
        evidence: Evidence,
        fitted: Fit,
        candidate: AxisEffect,
        bounds: tuple[float, float],
        origin: float,
        gain: float,
    ) -> None:
        self._evidence, self._fitted, self._candidate = evidence, fitted, candidate
        self._bounds, self._gain = bounds, gain
        self._places = [
            o.record.signal(evidence.axis, Tap.CMD) - origin for o in evidence.observations
        ]

    def clearest(self, period: float) -> list[int]:
        """Return the records of which a sawtooth of this width takes a share, the most first."""
        shares: dict[int, float] = {}
        for part in self._evidence.parts:
            gap = self._fitted.residual[part.rows]
            power = float(gap @ gap)
            if part.tap is not Tap.U and power > 0.0:
                place = self._places[part.record]
                taken = max(_likeness(place, gap, period, k / _SHIFTS) for k in range(_SHIFTS))
                shares[part.record] = max(shares.get(part.record, 0.0), taken / power)
        clear = [number for number, share in shares.items() if share >= _PROMISES]
        return sorted(clear, key=lambda number: -shares[number])

    def matched(self, record: int, period: float) -> dict[str, float] | None:
        """Return the grid that suits a record, and then one record more at a time."""
        centre = float(self._places[record].mean())
        teeth = max(float(np.ptp(self._places[record])) / period, 1.0)
        widths = period * (1.0 + np.linspace(-_OFF, _OFF, _WIDTHS) / teeth)
        tried = [(width, k / _SHIFTS - 0.5) for width in widths for k in range(_SHIFTS)]
        own = [record]
        width, shift = min(tried, key=lambda one: self._left(one, own))
        rows = [part.rows for part in self._evidence.parts if part.record == record]
        before = sum(float(np.sum(self._fitted.residual[part] ** 2)) for part in rows)
        if self._left((width, shift), own) > (1.0 - _CLOSES) * before:
            return None
        reached = float(np.abs(self._places[record] - centre).max())
        others = [number for number in range(len(self._places)) if number != record]
        for other in sorted(others, key=lambda number: self._away(number, centre)):
            own.append(other)
            away = self._away(other, centre)
            if away > reached:
                phase = centre / width - shift
                count = int(min(2.0 * _OFF * away / reached * _FINE, _MOST)) + 1
                widths = width + np.linspace(-_OFF, _OFF, count) * width**2 / reached
                grids = [(float(one), _wrapped(centre / one - phase)) for one in widths]
                width, shift = min(grids, key=lambda one: self._left(one, own))
                reached = away
        width, shift = self._polished(width, shift, centre, reached, own)
        return {"step": width / self._gain, "shift": shift}

    def _polished(
        self, width: float, shift: float, centre: float, reached: float, records: Sequence[int]
    ) -> tuple[float, float]:
        """Return a grid moved by ever smaller parts of a tooth, at ``centre`` and far from it."""
        for part in _PARTS:
            tried = []
            for there in (-part, 0.0, part):
                moved = width + there * width**2 / reached
                phase = centre / width - shift
                tried += [
                    (moved, _wrapped(centre / moved - phase - here)) for here in (-part, 0.0, part)
                ]
            width, shift = min(tried, key=lambda one: self._left(one, records))
        return width, shift

    def _away(self, record: int, centre: float) -> float:
        return float(np.abs(self._places[record] - centre).max())

    def _left(self, grid: tuple[float, float], records: Sequence[int]) -> float:
        """Return the sum of squares that a grid, its width and shift, leaves of some records."""
        width, shift = grid
        if not self._bounds[0] <= width <= self._bounds[1]:
            return np.inf
        numbers: Mapping[str, float] = {"step": width / self._gain, "shift": shift}
        asked = replace(self._candidate, parameters={**self._candidate.parameters, **numbers})
        left = self._evidence.residual([*self._fitted.effects, asked], records)
        return float(left @ left)


def _wrapped(shift: float) -> float:
    return shift - round(shift)


def _likeness(place: FloatArray, gap: FloatArray, period: float, shift: float) -> float:
    """Return how much of a gap (n,) a sawtooth over place (n,) takes away."""
    turns = place / period - shift
    teeth = np.rint(turns) - turns
    teeth = teeth - teeth.mean()
    return float(max(teeth @ gap, 0.0) ** 2 / (teeth @ teeth + 1e-30))
