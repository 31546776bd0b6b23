"""Figures of hysteresis loops: width, area, saturation, dependence on amplitude."""

from bisect import bisect_left, bisect_right
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import (
    IdentificationSettingError,
    InsufficientExcitationError,
    TooShortError,
)
from rotemina.sim.identification.experiment_signals import check_moving

# Number of inputs at which the two branches are compared.
_GRID_COUNT = 401
# Smallest share of a cycle's input span that both branches must have in common.
_MIN_COMMON_SPAN_RATIO = 0.6
# The output has reached its final value when it is this close to it, as a share of its stroke.
_END_TOLERANCE_RATIO = 0.01
# The output saturates if it reaches its final value at least this share of the input span before
# the turning point.
_MIN_SATURATION_RATIO = 0.05
# Smallest ratio of the largest to the smallest amplitude for which an exponent can be fitted.
_MIN_AMPLITUDE_RATIO = 1.2


class HysteresisLoop(NamedTuple):
    """Figures of one cycle of the input.

    A cycle runs from one low turning point to the next. If the record has no such cycle, it runs
    from one high turning point to the next.

    Attributes
    ----------
    rows : (int, int)
        First and last row of the cycle in the input.
    input_low, input_high : float
        Turning points, input unit. Both branches cover the span between them.
    stroke : float
        Change of the output between the turning points, output unit.
    width_mid, width_max : float
        Output of the falling branch minus output of the rising branch at the same input: at the
        middle of the span, and where the difference is largest. Positive if the output lags.
    input_width_mid : float
        Input of the rising branch minus input of the falling branch at the middle output, input
        unit. It is the play of a backlash.
    width_percent : float
        100 ``width_max`` over ``stroke``.
    area : float
        ∮ y dx of the closed cycle, input unit × output unit; positive if the output lags.
    saturation_low, saturation_high : float or None
        Input from which the output stays within 1 % of its stroke from its final value, while the
        input approaches the turning point. None if that is less than 5 % of the input span before
        it.
    """

    rows: tuple[int, int]
    input_low: float
    input_high: float
    stroke: float
    width_mid: float
    width_max: float
    input_width_mid: float
    width_percent: float
    area: float
    saturation_low: float | None
    saturation_high: float | None

    @property
    def amplitude(self) -> float:
        """Half the input's span, input unit."""
        return (self.input_high - self.input_low) / 2.0


def measure_loops(
    input_signal: FloatArray,
    output_signal: FloatArray,
    *,
    lag_samples: int = 0,
    min_swing: float = 0.02,
) -> tuple[HysteresisLoop, ...]:
    """Cut a record into cycles of its input and measure the loop of each cycle.

    Parameters
    ----------
    input_signal, output_signal : (n,)
        Input and output. Cycles may have any shape and contain holds.
    lag_samples : int
        Samples by which the output is read later than the input that causes it. Use 1 for a
        command that is held from its row on and a sensor that is read just before the next row.
    min_swing : float
        Smallest swing of a cycle, as a share of the input's peak-to-peak value. Smaller reversals
        count as noise.

    Raises
    ------
    IdentificationSettingError
        If a parameter is out of range.
    TooShortError
        If there are too few samples, or input and output differ in length.
    InsufficientExcitationError
        If the input does not move or makes no whole cycle.
    """
    if lag_samples < 0 or not 0.0 < min_swing < 1.0:
        raise IdentificationSettingError(
            "loops: lag of {lag_samples} samples, minimum swing {least_swing}; the lag must"
            " be 0 or more, the swing in (0, 1)",
            lag_samples=lag_samples,
            least_swing=repr(min_swing),
        )
    count = len(input_signal) - lag_samples
    if count < 3 or len(output_signal) != len(input_signal):
        raise TooShortError(
            "loops: {inputs} samples of input, {outputs} of output, {lag_samples} of "
            "lag; input and output must be equally long, with at least three samples left",
            inputs=len(input_signal),
            outputs=len(output_signal),
            lag_samples=lag_samples,
        )
    x, y = input_signal[:count], output_signal[lag_samples:]
    check_moving(x, "input")
    highs, lows = _find_turning_points(x, min_swing * float(np.ptp(x)))
    measured_loops = _measure_cycles(x, y, lows, highs) or [
        _negate_loop(loop) for loop in _measure_cycles(-x, -y, highs, lows)
    ]
    if not measured_loops:
        raise InsufficientExcitationError(
            "loops: the input makes no whole cycle from one turning point to the next one "
            "of the same kind; record another cycle"
        )
    return tuple(measured_loops)


def _measure_cycles(
    x: FloatArray, y: FloatArray, lows: list[int], highs: list[int]
) -> list[HysteresisLoop]:
    measured_loops = []
    for begin, end in pairwise(lows):
        highs_between = highs[bisect_right(highs, begin) : bisect_left(highs, end)]
        if highs_between:
            top = max(highs_between, key=lambda row: float(x[row]))
            loop = _measure_cycle(x, y, begin, top, end)
            measured_loops += [loop] if loop is not None else []
    return measured_loops


def _negate_loop(loop: HysteresisLoop) -> HysteresisLoop:
    """Return the loop of the original signals from the loop of the negated ones."""
    low, high = loop.saturation_low, loop.saturation_high
    return loop._replace(
        input_low=-loop.input_high,
        input_high=-loop.input_low,
        saturation_low=None if high is None else -high,
        saturation_high=None if low is None else -low,
    )


def fit_amplitude_exponent(measured: tuple[HysteresisLoop, ...]) -> float:
    """Fit p of ``|width_max| ∝ amplitude^p`` by least squares of the logarithms.

    An exponent of 0 indicates backlash. An exponent of 1 indicates creep, a lag, or a play-type
    hysteresis far beyond its thresholds. Exponents up to 2 indicate hysteresis at small amplitude
    (Rayleigh's law, Lord Rayleigh, *Phil. Mag.* 23 (1887) 225).

    Raises
    ------
    InsufficientExcitationError
        If amplitudes differ by less than a factor of 1.2, or a loop has no width.
    """
    amplitude = np.array([loop.amplitude for loop in measured])
    width = np.abs([loop.width_max for loop in measured])
    if len(measured) < 2 or amplitude.max() < _MIN_AMPLITUDE_RATIO * amplitude.min():
        raise InsufficientExcitationError(
            "amplitude dependence: {count} loops whose amplitudes differ by less than a factor "
            "of {least_spread}; record growing or decaying cycles",
            count=len(measured),
            least_spread=_MIN_AMPLITUDE_RATIO,
        )
    if np.any(width == 0.0):
        raise InsufficientExcitationError(
            "amplitude dependence: a loop has no width; there is nothing to fit"
        )
    slope, _ = np.polyfit(np.log(amplitude), np.log(width), 1)
    return float(slope)


def _find_turning_points(x: FloatArray, min_prominence: float) -> tuple[list[int], list[int]]:
    """Return the rows of maxima and minima of at least the given prominence, ends included."""
    # Imported here because the import is slow.
    from scipy.signal import find_peaks

    rows = []
    for signal in (x, -x):
        padded = np.r_[signal.min() - 1.0, signal, signal.min() - 1.0]
        peaks, _ = find_peaks(padded, prominence=min_prominence)
        rows.append([int(row) - 1 for row in peaks])
    return rows[0], rows[1]


def _measure_cycle(
    x: FloatArray, y: FloatArray, begin: int, top: int, end: int
) -> HysteresisLoop | None:
    low, high = float(max(x[begin], x[end])), float(x[top])
    if high - low < _MIN_COMMON_SPAN_RATIO * (high - float(min(x[begin], x[end]))):
        return None
    rising = _make_monotonic(x[begin : top + 1], y[begin : top + 1])
    falling = _make_monotonic(x[top : end + 1][::-1], y[top : end + 1][::-1])
    grid = np.linspace(low, high, _GRID_COUNT)
    up, down = (np.interp(grid, *branch) for branch in (rising, falling))
    widths = down - up
    max_width = float(widths[np.argmax(np.abs(widths))])
    end_outputs = (up[0] + down[0]) / 2.0, (up[-1] + down[-1]) / 2.0
    stroke = float(end_outputs[1] - end_outputs[0])
    cycle_x, cycle_y = x[begin : end + 1], y[begin : end + 1]
    return HysteresisLoop(
        rows=(begin, end),
        input_low=low,
        input_high=high,
        stroke=stroke,
        width_mid=float(widths[_GRID_COUNT // 2]),
        width_max=max_width,
        input_width_mid=_find_mid_crossing(grid, up, end_outputs)
        - _find_mid_crossing(grid, down, end_outputs),
        width_percent=100.0 * max_width / abs(stroke) if stroke else np.inf,
        area=_compute_area(cycle_x, cycle_y),
        saturation_low=_find_saturation(grid[::-1], down[::-1], stroke),
        saturation_high=_find_saturation(grid, up, stroke),
    )


def _make_monotonic(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return increasing inputs of a branch and their outputs, with the last row of each hold."""
    rising = np.maximum.accumulate(x)
    is_last = np.r_[np.diff(rising) > 0, True]
    return rising[is_last], y[is_last]


def _find_mid_crossing(
    grid: FloatArray, branch: FloatArray, end_outputs: tuple[float, float]
) -> float:
    sign = 1.0 if end_outputs[1] >= end_outputs[0] else -1.0
    distances = np.maximum.accumulate(sign * (branch - (end_outputs[0] + end_outputs[1]) / 2.0))
    row = int(np.argmax(distances >= 0.0))
    if row == 0:
        return float(grid[0] if distances[0] >= 0.0 else grid[-1])
    fraction = distances[row - 1] / (distances[row - 1] - distances[row])
    return float(grid[row - 1] + fraction * (grid[row] - grid[row - 1]))


def _compute_area(x: FloatArray, y: FloatArray) -> float:
    """Return the signed area of a polygon by the shoelace formula.

    The mean of the points is subtracted first, which reduces rounding errors.
    """
    a, b = x - x.mean(), y - y.mean()
    return float(0.5 * (np.dot(a, np.roll(b, -1)) - np.dot(b, np.roll(a, -1))))


def _find_saturation(grid: FloatArray, branch: FloatArray, stroke: float) -> float | None:
    outside = np.flatnonzero(np.abs(branch - branch[-1]) > _END_TOLERANCE_RATIO * abs(stroke))
    if len(outside) == 0 or outside[-1] + 1 >= len(grid):
        return None
    reached_input = float(grid[outside[-1] + 1])
    is_early = abs(grid[-1] - reached_input) >= _MIN_SATURATION_RATIO * abs(grid[-1] - grid[0])
    return reached_input if is_early else None
