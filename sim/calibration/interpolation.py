"""The period of an encoder's interpolation error, found in the residual of a smooth model.

Where the axis crept, the spectrum of the residual over position has lines. The powers of all
creeping stretches are added without their phases (periodograms after Lomb, Astrophysics and Space
Science 39 (1976) 447–462), which gives a rough period. Then both harmonics are fitted together with
a linear trend in each stretch: first with separate phases, then with one common phase. The common
phase counts the periods between distant stretches, so the period becomes accurate enough for the
whole range.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.calibration.comparable_parts import find_stretches
from rotemina.sim.calibration.regression_columns import GramMatrix, SensorRun
from rotemina.sim.calibration.sensor import compute_waves

_MIN_PERIODS_PER_STRETCH = 3.0
_MIN_ROWS_PER_PERIOD = 6.0
_MIN_STRETCH_ROWS = 200
# A spectral line has at least this many times the median power.
_LINE_TO_MEDIAN_RATIO = 12.0
# The fine grid has this many frequencies per resolution of the whole travel.
_FINE_GRID_FACTOR = 8.0
_MIN_FREQUENCIES = 20
_MAX_ROWS = 12_000
# Processing at most this many frequencies at a time limits the memory.
_FREQUENCIES_PER_BATCH = 256


class _CreepingStretches(NamedTuple):
    """Creeping stretches: positions, residuals without trend, and basis (n, 2) of each trend.

    The trend of a stretch is a straight line over position.
    """

    positions: list[FloatArray]
    residuals: list[FloatArray]
    trends: list[FloatArray]

    @property
    def length(self) -> float:
        """Median travel of the stretches, m or rad."""
        return float(np.median([np.ptp(position) for position in self.positions]))

    def compute_powers(self, frequencies: FloatArray) -> FloatArray:
        """Return the summed powers (f,) at frequencies (f,), 1/m."""
        pairs = zip(self.positions, self.residuals, strict=True)
        return np.asarray(
            np.sum(
                [np.abs(_compute_fourier_sums(*pair, frequencies)) ** 2 for pair in pairs], axis=0
            )
        )

    def compute_explained_squares(self, frequency: float, *, common_phase: bool) -> float:
        """Return the sum of squares that both harmonics explain.

        With ``common_phase`` all stretches share one phase; otherwise each has a separate phase.
        """
        parts = []
        for position, residual, trend in zip(*self, strict=True):
            waves = compute_waves(position, 1.0 / frequency)
            parts.append(GramMatrix.of(waves - trend @ (trend.T @ waves), residual))
        if common_phase:
            parts = [GramMatrix.total(parts)]
        return sum(float(part.solve() @ part.vector) for part in parts)


def find_period(runs: list[SensorRun], remainders: list[FloatArray]) -> float:
    """Return the period over position, m or rad, or 0 if the residual has no period."""
    stretches = _find_creeping_stretches(runs, remainders)
    if stretches is None:
        return 0.0
    length = stretches.length
    row_distance = float(
        np.median([np.abs(np.diff(position)).mean() for position in stretches.positions])
    )
    frequencies = np.arange(
        _MIN_PERIODS_PER_STRETCH / length,
        1.0 / (_MIN_ROWS_PER_PERIOD * row_distance),
        0.25 / length,
    )
    if len(frequencies) < _MIN_FREQUENCIES:
        return 0.0
    powers = stretches.compute_powers(frequencies)
    # An error with two harmonics has two spectral lines. The lower frequency belongs to the period.
    strong_indices = np.flatnonzero(
        powers > max(_LINE_TO_MEDIAN_RATIO * float(np.median(powers)), 0.1 * powers.max())
    )
    if not len(strong_indices):
        return 0.0
    first_strong = int(strong_indices[0])
    frequency = float(
        frequencies[first_strong + int(np.argmax(powers[first_strong : first_strong + 8]))]
    )
    travel = max(float(np.ptp(np.concatenate(stretches.positions))), length)
    for half_width, step, common_phase in (
        (0.5 / length, 0.02 / length, False),
        (0.02 / length, 1.0 / (_FINE_GRID_FACTOR * travel), True),
    ):
        grid = frequency + np.arange(-half_width, half_width, step)
        explained = np.array(
            [
                stretches.compute_explained_squares(candidate, common_phase=common_phase)
                for candidate in grid
            ]
        )
        frequency = _refine_peak(grid, explained, int(np.argmax(explained)))
    return 1.0 / frequency


def _refine_peak(frequencies: FloatArray, powers: FloatArray, peak: int) -> float:
    if not 0 < peak < len(powers) - 1:
        return float(frequencies[peak])
    before, top, after = powers[peak - 1 : peak + 2]
    curvature = before - 2.0 * top + after
    shift = 0.5 * (before - after) / curvature if curvature else 0.0
    return float(frequencies[peak] + shift * (frequencies[1] - frequencies[0]))


def _compute_fourier_sums(
    position: FloatArray, residual: FloatArray, frequencies: FloatArray
) -> FloatArray:
    parts = [
        np.exp(
            -2j * np.pi * np.outer(frequencies[begin : begin + _FREQUENCIES_PER_BATCH], position)
        )
        @ residual
        for begin in range(0, len(frequencies), _FREQUENCIES_PER_BATCH)
    ]
    return np.concatenate(parts)


def _find_creeping_stretches(
    runs: list[SensorRun], remainders: list[FloatArray]
) -> _CreepingStretches | None:
    """Find where the axis crept slower than a twentieth of its highest speed."""
    max_speed = max(float(_compute_speeds_per_row(run).max()) for run in runs)
    creeping = [
        (run.reference[rows], remainder[rows])
        for run, remainder in zip(runs, remainders, strict=True)
        for rows in find_stretches(_find_creeping_rows(_compute_speeds_per_row(run), max_speed))
        if rows.stop - rows.start >= _MIN_STRETCH_ROWS
    ]
    if not creeping:
        return None
    stride = max(1, sum(len(position) for position, _ in creeping) // _MAX_ROWS)
    positions, residuals, trends = [], [], []
    for position, remainder in creeping:
        positions.append(position[::stride])
        centred = positions[-1] - positions[-1].mean()
        trends.append(np.linalg.qr(np.stack([np.ones_like(centred), centred], axis=1))[0])
        selected = remainder[::stride]
        residuals.append(selected - trends[-1] @ (trends[-1].T @ selected))
    return _CreepingStretches(positions, residuals, trends)


def _find_creeping_rows(speeds: FloatArray, max_speed: float) -> BoolArray:
    return np.asarray((speeds < 0.05 * max_speed) & (speeds > 1e-4 * max_speed))


def _compute_speeds_per_row(run: SensorRun) -> FloatArray:
    """Return smoothed speeds (n,), in m or rad per row."""
    window = np.ones(25) / 25.0
    return np.abs(np.convolve(np.gradient(run.reference), window, mode="same"))
