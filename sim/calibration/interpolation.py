"""The period of an encoder's interpolation error, from the residual of a smooth model.

Where the axis crept, the remainder has lines in its spectrum over position. Powers of the creeping
stretches are added without their phases (Lomb, Astrophysics and Space Science 39 (1976) 447–462,
of each), which finds about where. Then both harmonics are fitted beside a line through each
stretch, first to each by itself; then to all at once, which makes the period sharp enough for the
whole range, as stretches far apart count the periods between them.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.calibration.comparable_parts import stretches
from rotemina.sim.calibration.regression_columns import Gram, Run
from rotemina.sim.calibration.sensor import waves

_LEAST_PERIODS = 3.0  # in a stretch
_ROWS_A_PERIOD = 6.0
_LEAST_ROWS = 200
_OVER = 12.0  # times the median power: a line
_FINER = 8.0
_LEAST_LINES = 20
_MOST_ROWS = 12_000
_PORTION = 256


class _Stretches(NamedTuple):
    """Creeping stretches: position, remainder without its line, and that line's basis (n, 2)."""

    position: list[FloatArray]
    remainder: list[FloatArray]
    lines: list[FloatArray]

    @property
    def length(self) -> float:
        return float(np.median([np.ptp(each) for each in self.position]))

    def powers(self, frequencies: FloatArray) -> FloatArray:
        """Return the added powers (f,) at frequencies (f,), 1/m."""
        pairs = zip(self.position, self.remainder, strict=True)
        return np.asarray(
            np.sum([np.abs(_sums(*pair, frequencies)) ** 2 for pair in pairs], axis=0)
        )

    def explained(self, frequency: float, *, together: bool) -> float:
        """Return the sum of squares that both harmonics explain, of all with the same phase."""
        parts = []
        for position, remainder, line in zip(*self, strict=True):
            table = waves(position, 1.0 / frequency)
            parts.append(Gram.of(table - line @ (line.T @ table), remainder))
        if together:
            parts = [Gram.total(parts)]
        return sum(float(part.solved() @ part.vector) for part in parts)


def found_period(runs: list[Run], remainders: list[FloatArray]) -> float:
    """Return the period over position, m or rad, or 0 if nothing repeats."""
    stretches = _stretches(runs, remainders)
    if stretches is None:
        return 0.0
    length = stretches.length
    pitch = float(np.median([np.abs(np.diff(each)).mean() for each in stretches.position]))
    frequencies = np.arange(_LEAST_PERIODS / length, 1.0 / (_ROWS_A_PERIOD * pitch), 0.25 / length)
    if len(frequencies) < _LEAST_LINES:
        return 0.0
    powers = stretches.powers(frequencies)
    # An error of two harmonics has two lines, of which the slower one is the period's.
    strong = np.flatnonzero(powers > max(_OVER * float(np.median(powers)), 0.1 * powers.max()))
    if not len(strong):
        return 0.0
    first = int(strong[0])
    about = float(frequencies[first + int(np.argmax(powers[first : first + 8]))])
    reach = max(float(np.ptp(np.concatenate(stretches.position))), length)
    for around, step, together in (
        (0.5 / length, 0.02 / length, False),
        (0.02 / length, 1.0 / (_FINER * reach), True),
    ):
        grid = about + np.arange(-around, around, step)
        found = np.array([stretches.explained(each, together=together) for each in grid])
        about = _about(grid, found, int(np.argmax(found)))
    return 1.0 / about


def _about(frequencies: FloatArray, powers: FloatArray, peak: int) -> float:
    """Return where the parabola through a peak and its neighbours is highest."""
    if not 0 < peak < len(powers) - 1:
        return float(frequencies[peak])
    left, top, right = powers[peak - 1 : peak + 2]
    bow = left - 2.0 * top + right
    shift = 0.5 * (left - right) / bow if bow else 0.0
    return float(frequencies[peak] + shift * (frequencies[1] - frequencies[0]))


def _sums(position: FloatArray, remainder: FloatArray, frequencies: FloatArray) -> FloatArray:
    parts = [
        np.exp(-2j * np.pi * np.outer(frequencies[at : at + _PORTION], position)) @ remainder
        for at in range(0, len(frequencies), _PORTION)
    ]
    return np.concatenate(parts)


def _stretches(runs: list[Run], remainders: list[FloatArray]) -> _Stretches | None:
    """Return where the axis crept: at a speed below a twentieth of its fastest."""
    fastest = max(float(_paces(run).max()) for run in runs)
    found = [
        (run.reference[rows], remainder[rows])
        for run, remainder in zip(runs, remainders, strict=True)
        for rows in stretches(_creeping(_paces(run), fastest))
        if rows.stop - rows.start >= _LEAST_ROWS
    ]
    if not found:
        return None
    every = max(1, sum(len(position) for position, _ in found) // _MOST_ROWS)
    positions, rest, lines = [], [], []
    for position, remainder in found:
        positions.append(position[::every])
        centred = positions[-1] - positions[-1].mean()
        lines.append(np.linalg.qr(np.stack([np.ones_like(centred), centred], axis=1))[0])
        kept = remainder[::every]
        rest.append(kept - lines[-1] @ (lines[-1].T @ kept))
    return _Stretches(positions, rest, lines)


def _creeping(paces: FloatArray, fastest: float) -> BoolArray:
    return np.asarray((paces < 0.05 * fastest) & (paces > 1e-4 * fastest))


def _paces(run: Run) -> FloatArray:
    """Return smoothed speeds (n,), m or rad a row."""
    window = np.ones(25) / 25.0
    return np.abs(np.convolve(np.gradient(run.reference), window, mode="same"))
