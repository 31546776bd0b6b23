"""Figures of hysteresis loops: width, area, ends that saturate, dependence on amplitude."""

from bisect import bisect_left, bisect_right
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.errors import ExcitationError, SettingError, TooShortError
from rotemina.sim.identification.experiment_signals import check_moving
from rotemina.sim.messages import message

_GRID = 401  # inputs at which the two branches are compared
_COMMON = 0.6  # of a cycle's input span, that both branches must share
_FLAT = 0.01  # of the output's stroke, within which an end counts as reached
_EARLY = 0.05  # of the input's span, by which it must be reached before the turning point
_LEAST_SPREAD = 1.2  # of amplitudes, from which an exponent can be told


class Loop(NamedTuple):
    """One cycle of the input: from low turning point to low, or high to high if none is so.

    Attributes
    ----------
    rows : first and last row of the cycle, of the input.
    input_low, input_high : turning points, input unit; both branches cover what lies between.
    stroke : of the output between them, output unit.
    width_mid, width_max : output going down minus going up at the same input, at the middle and
        where it is largest in size; positive where the output lags the input.
    input_width_mid : the same across: input going up minus going down at the middle output, input
        unit; the play of a backlash.
    width_percent : ``width_max`` over ``stroke``.
    area : ∮ y dx of the closed cycle, input unit × output unit, positive where the output lags.
    saturation_low, saturation_high : input from which on the approach to an end leaves the output
        within 1 % of its stroke, if that is 5 % of the input's span or more before it; else None.
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


def loops(
    driven: FloatArray, answer: FloatArray, *, lag_samples: int = 0, least_swing: float = 0.02
) -> tuple[Loop, ...]:
    """Cut a record into cycles of its input and measure each loop.

    Parameters
    ----------
    driven, answer : (n,) input and output; any shape of cycle, holds included.
    lag_samples : by which the answer is read later than the input that it belongs to: 1 for a
        command held from its row on and a sensor read just before the next one.
    least_swing : of the input's peak-to-peak; smaller reversals are noise.

    Raises
    ------
    SettingError, TooShortError, ExcitationError
        If the input does not move, or makes no whole cycle.
    """
    if lag_samples < 0 or not 0.0 < least_swing < 1.0:
        raise SettingError(
            message(
                "engine",
                "loops: {lag_samples} samples of lag, least swing {least_swing}; use 0 or more, "
                "and a swing in (0, 1)",
            ).fill(lag_samples=lag_samples, least_swing=repr(least_swing))
        )
    count = len(driven) - lag_samples
    if count < 3 or len(answer) != len(driven):
        raise TooShortError(
            message(
                "engine",
                "loops: {inputs} samples of input, {outputs} of output, {lag_samples} of "
                "lag; input and output must be equally long, with at least three samples left",
            ).fill(inputs=len(driven), outputs=len(answer), lag_samples=lag_samples)
        )
    x, y = driven[:count], answer[lag_samples:]
    check_moving(x, "input")
    highs, lows = _turning_points(x, least_swing * float(np.ptp(x)))
    found = _cycles(x, y, lows, highs) or [_mirrored(each) for each in _cycles(-x, -y, highs, lows)]
    if not found:
        raise ExcitationError(
            message(
                "engine",
                "loops: the input makes no whole cycle from one turning point to the next of its "
                "kind; record one cycle more",
            )
        )
    return tuple(found)


def _cycles(x: FloatArray, y: FloatArray, lows: list[int], highs: list[int]) -> list[Loop]:
    found = []
    for begin, end in pairwise(lows):
        between = highs[bisect_right(highs, begin) : bisect_left(highs, end)]
        if between:
            top = max(between, key=lambda row: float(x[row]))
            loop = _measure(x, y, begin, top, end)
            found += [loop] if loop is not None else []
    return found


def _mirrored(loop: Loop) -> Loop:
    """Return the loop of an input and output that were both negated to find it."""
    low, high = loop.saturation_low, loop.saturation_high
    return loop._replace(
        input_low=-loop.input_high,
        input_high=-loop.input_low,
        saturation_low=None if high is None else -high,
        saturation_high=None if low is None else -low,
    )


def amplitude_exponent(measured: tuple[Loop, ...]) -> float:
    """Return p of ``|width_max| ∝ amplitude^p`` by least squares of the logarithms.

    0: backlash. 1: creep, a lag, or a play-type hysteresis far beyond its thresholds. Up to 2:
    hysteresis at small amplitude (Rayleigh's law, Lord Rayleigh, *Phil. Mag.* 23 (1887) 225).

    Raises
    ------
    ExcitationError
        If amplitudes differ by less than a factor of 1.2, or a loop has no width.
    """
    amplitude = np.array([each.amplitude for each in measured])
    width = np.abs([each.width_max for each in measured])
    if len(measured) < 2 or amplitude.max() < _LEAST_SPREAD * amplitude.min():
        raise ExcitationError(
            message(
                "engine",
                "amplitude dependence: {count} loops whose amplitudes differ by less than a factor "
                "of {least_spread}; record growing or decaying cycles",
            ).fill(count=len(measured), least_spread=_LEAST_SPREAD)
        )
    if np.any(width == 0.0):
        raise ExcitationError(
            message("engine", "amplitude dependence: a loop has no width; there is nothing to fit")
        )
    slope, _ = np.polyfit(np.log(amplitude), np.log(width), 1)
    return float(slope)


def _turning_points(x: FloatArray, least: float) -> tuple[list[int], list[int]]:
    """Return rows of highs and lows whose prominence is ``least`` or more, ends included."""
    from scipy.signal import find_peaks  # takes its time to import

    rows = []
    for signal in (x, -x):
        padded = np.r_[signal.min() - 1.0, signal, signal.min() - 1.0]
        peaks, _ = find_peaks(padded, prominence=least)
        rows.append([int(row) - 1 for row in peaks])
    return rows[0], rows[1]


def _measure(x: FloatArray, y: FloatArray, begin: int, top: int, end: int) -> Loop | None:
    low, high = float(max(x[begin], x[end])), float(x[top])
    if high - low < _COMMON * (high - float(min(x[begin], x[end]))):
        return None
    rising = _branch(x[begin : top + 1], y[begin : top + 1])
    falling = _branch(x[top : end + 1][::-1], y[top : end + 1][::-1])
    grid = np.linspace(low, high, _GRID)
    up, down = (np.interp(grid, *branch) for branch in (rising, falling))
    width = down - up
    widest = float(width[np.argmax(np.abs(width))])
    ends = (up[0] + down[0]) / 2.0, (up[-1] + down[-1]) / 2.0
    stroke = float(ends[1] - ends[0])
    cycle_x, cycle_y = x[begin : end + 1], y[begin : end + 1]
    return Loop(
        rows=(begin, end),
        input_low=low,
        input_high=high,
        stroke=stroke,
        width_mid=float(width[_GRID // 2]),
        width_max=widest,
        input_width_mid=_crossing(grid, up, ends) - _crossing(grid, down, ends),
        width_percent=100.0 * widest / abs(stroke) if stroke else np.inf,
        area=_area(cycle_x, cycle_y),
        saturation_low=_saturation(grid[::-1], down[::-1], stroke),
        saturation_high=_saturation(grid, up, stroke),
    )


def _branch(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return a branch as increasing inputs and their outputs; the last row of a hold counts."""
    rising = np.maximum.accumulate(x)
    last = np.r_[np.diff(rising) > 0, True]
    return rising[last], y[last]


def _crossing(grid: FloatArray, branch: FloatArray, ends: tuple[float, float]) -> float:
    """Return the input at which a branch first passes the middle of the output."""
    sign = 1.0 if ends[1] >= ends[0] else -1.0
    passed = np.maximum.accumulate(sign * (branch - (ends[0] + ends[1]) / 2.0))
    row = int(np.argmax(passed >= 0.0))
    if row == 0:
        return float(grid[0] if passed[0] >= 0.0 else grid[-1])
    share = passed[row - 1] / (passed[row - 1] - passed[row])
    return float(grid[row - 1] + share * (grid[row] - grid[row - 1]))


def _area(x: FloatArray, y: FloatArray) -> float:
    """Return the signed area of a polygon by the shoelace formula, about its middle."""
    a, b = x - x.mean(), y - y.mean()
    return float(0.5 * (np.dot(a, np.roll(b, -1)) - np.dot(b, np.roll(a, -1))))


def _saturation(grid: FloatArray, branch: FloatArray, stroke: float) -> float | None:
    off = np.flatnonzero(np.abs(branch - branch[-1]) > _FLAT * abs(stroke))
    if len(off) == 0 or off[-1] + 1 >= len(grid):
        return None
    reached = float(grid[off[-1] + 1])
    early = abs(grid[-1] - reached) >= _EARLY * abs(grid[-1] - grid[0])
    return reached if early else None
