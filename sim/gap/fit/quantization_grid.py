"""The steps of a coarse converter: their width, and the position of one of them.

There may be thousands along the travel. No descent finds them, but over the command the remainder,
seen from the input, is a sawtooth: its spectral line gives the width precisely enough for one
record, that record gives it precisely enough for the next one, and so on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit.equivalent_input import inputs_left
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import Fit
from rotemina.sim.gap.fit.strongest_line import line_over
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

_SHIFTS = 12
_OFF = 0.5  # of a tooth, that a width may be off at the ends of a record
_FINE = 12  # parts of a tooth, to which the next record is matched
_MOST = 600  # widths that are tried on a further record
_PARTS = (0.04, 0.02, 0.008, 0.003, 0.001)  # of a tooth, by which a grid is moved at last
_PROMISES = 0.08  # of what is left of a record, that a sawtooth takes away
_BURST = 5.0  # times its usual size, that what is left of a tooth has at most
_CANDIDATES = 3  # lines that are looked at


class Seen(NamedTuple):
    """What is left (n,) of a record over a place (n,), from which teeth are counted, m or rad."""

    record: int
    place: FloatArray
    left: FloatArray


def likeliest_grid(
    evidence: Evidence,
    fitted: Fit,
    candidate: AxisEffect,
    bounds: tuple[float, float],
    origin: float,
    gain: float,
    *,
    at_input: bool,
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
    at_input : bool
        Whether the converter is at the command, and not at the sensor.
    """
    seen = _seen(evidence, fitted, origin, at_input=at_input)
    found: tuple[float, Grid] | None = None
    for line in _lines(seen, bounds):
        share, grid = _matched(seen, line)
        if found is None or share > found[0]:
            found = share, grid
    if found is None or found[0] < _PROMISES:
        return None
    grid = _Polish(evidence, fitted, candidate, bounds, gain).polished(found[1], seen)
    return {"step": grid.width / gain, "shift": grid.shift}


class Grid(NamedTuple):
    """Teeth: their width, m or rad, and their shift as a fraction of the width."""

    width: float
    shift: float

    def moved(self, centre: float, reach: float, far: float, here: float) -> "Grid":
        """Return a grid moved by parts of a tooth: ``here`` at a centre, ``far`` further away."""
        width = self.width + far * self.width**2 / reach
        phase = centre / self.width - self.shift + here
        shift = centre / width - phase
        return Grid(width, shift - round(shift))

    def taken(self, one: Seen) -> float:
        """Return how much of the remainder it removes, as a sum of squares."""
        turns = one.place / self.width - self.shift
        teeth = np.rint(turns) - turns
        teeth = teeth - teeth.mean()
        return float(max(teeth @ one.left, 0.0) ** 2 / (teeth @ teeth + 1e-30))


def _seen(evidence: Evidence, fitted: Fit, origin: float, *, at_input: bool) -> list[Seen]:
    """Return the remainder at the converter: at the command, or at the sensor."""
    if at_input:
        places = [o.record.signal(evidence.axis, Tap.CMD) - origin for o in evidence.observations]
        return [
            Seen(part.record, places[part.record], _without_bursts(left))
            for part, left in inputs_left(evidence, fitted)
        ]
    answers = evidence.response(fitted.effects)
    return [
        Seen(part.record, answers[part.record][part.tap] - origin, fitted.residual[part.rows])
        for part in evidence.parts
        if part.tap is Tap.MEAS
    ]


def _without_bursts(left: FloatArray) -> FloatArray:
    """Return the remainder (n,) without spikes of the sensor, which no tooth can cause."""
    most = _BURST * float(np.median(np.abs(left)))
    return np.where(np.abs(left) > most, 0.0, left)


def _lines(seen: Sequence[Seen], bounds: tuple[float, float]) -> list[tuple[int, float]]:
    """Return parts and periods of the lines that promise most, one of each record at most."""
    found: dict[int, tuple[float, int, float]] = {}
    for number, one in enumerate(seen):
        period = line_over(one.place, one.left, bounds)
        if period is not None:
            share = max(Grid(period, k / _SHIFTS).taken(one) for k in range(_SHIFTS))
            promise = share / (float(one.left @ one.left) + 1e-30)
            nothing = (0.0, number, period)
            found[one.record] = max(found.get(one.record, nothing), (promise, number, period))
    best = sorted(found.values(), reverse=True)[:_CANDIDATES]
    return [(number, period) for _, number, period in best]


def _matched(seen: Sequence[Seen], line: tuple[int, float]) -> tuple[float, Grid]:
    """Return the grid that matches one part, then one more part at a time.

    Also return the share of the remainder that it removes, averaged over the records, each at the
    tap with the clearest teeth.
    """
    number, period = line
    first = seen[number]
    centre = float(first.place.mean())
    reached = max(float(np.abs(first.place - centre).max()), period)
    own = [first]
    tried = [
        Grid(period, k / _SHIFTS).moved(centre, reached, far, 0.0)
        for far in np.linspace(-_OFF, _OFF, 2 * _FINE + 1)
        for k in range(_SHIFTS)
    ]
    grid = max(tried, key=lambda one: _shares(one, own).sum())
    others = [one for k, one in enumerate(seen) if k != number]
    for other in sorted(others, key=lambda one: _away(one, centre)):
        own.append(other)
        away = _away(other, centre)
        if away > reached:
            count = int(min(2.0 * _OFF * away / reached * _FINE, _MOST)) + 1
            tried = [
                grid.moved(centre, reached, far, 0.0) for far in np.linspace(-_OFF, _OFF, count)
            ]
            grid = max(tried, key=lambda one: _shares(one, own).sum())
            reached = away
    for part in _PARTS:
        tried = [
            grid.moved(centre, reached, far, here)
            for far in (-part, 0.0, part)
            for here in (-part, 0.0, part)
        ]
        grid = max(tried, key=lambda one: _shares(one, own).sum())
    best: dict[int, float] = {}
    for one, share in zip(seen, _shares(grid, seen), strict=True):
        best[one.record] = max(best.get(one.record, 0.0), float(share))
    return float(np.mean(list(best.values()))), grid


def _shares(grid: Grid, seen: Sequence[Seen]) -> FloatArray:
    return np.array([grid.taken(one) / (float(one.left @ one.left) + 1e-30) for one in seen])


def _away(one: Seen, centre: float) -> float:
    return float(np.abs(one.place - centre).max())


@dataclass(frozen=True, eq=False)
class _Polish:
    """The last moves of a grid, by simulation."""

    evidence: Evidence
    fitted: Fit
    candidate: AxisEffect
    bounds: tuple[float, float]
    gain: float

    def polished(self, grid: Grid, seen: Sequence[Seen]) -> Grid:
        """Return a grid moved by ever smaller parts of a tooth, at the centre and far from it."""
        places = np.concatenate([one.place for one in seen])
        centre = float(places.mean())
        reach = max(float(np.abs(places - centre).max()), grid.width)
        for part in _PARTS:
            tried = [
                grid.moved(centre, reach, far, here)
                for far in (-part, 0.0, part)
                for here in (-part, 0.0, part)
            ]
            grid = min(tried, key=self._left)
        return grid

    def _left(self, grid: Grid) -> float:
        """Return the sum of squares that a grid leaves."""
        if not self.bounds[0] <= grid.width <= self.bounds[1]:
            return np.inf
        numbers: Mapping[str, float] = {"step": grid.width / self.gain, "shift": grid.shift}
        asked = replace(self.candidate, parameters={**self.candidate.parameters, **numbers})
        left = self.evidence.residual([*self.fitted.effects, asked])
        return float(left @ left)
