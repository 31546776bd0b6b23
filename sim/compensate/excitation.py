"""A motion that shows an axis' hysteresis loops of all sizes, over nearly the whole range.

It begins with swings of growing height from the low end. After each swing, the axis returns to a
certain share of its height. These swings show the behaviour of an axis that has not yet been at its
high end, which is how every inverse starts. Then swings fade around the middle, and random moves at
random speeds follow.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import CompensationError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import PiezoAxis, Robot

RATE_HZ = 2000.0
# Share of the range that stays free at each end.
_EDGE_SHARE = 0.02
_FADING_S, _RANDOM_S = 8.0, 14.0
_FADING_HZ = 1.0
# After each growing swing, the axis returns to the next of these shares of its height.
_GROWING_SWING_COUNT, _RETURN_SHARES = 14, (0.0, 0.5, 0.25)
# Speed of the growing swings.
_GROWING_RANGES_PER_S = 1.5
# Bounds of the speed of random moves.
_RANDOM_RANGES_PER_S = (0.3, 20.0)
# Corners are rounded over this time, so that the resonance is not excited.
_SMOOTHING_S = 0.04
_MIN_MOVE_S = 0.02


def make_excitation(robot: Robot, axis: str, rng: np.random.Generator) -> Record:
    """Return commands of one piezo axis: growing swings, fading swings, then random moves.

    Raises
    ------
    CompensationError
        If the robot has no such piezo axis.
    """
    axis_model = robot.axes.get(axis)
    if not isinstance(axis_model, PiezoAxis):
        raise CompensationError(
            "axis {axis}: robot {name} has no such piezo axis",
            axis=repr(axis),
            name=repr(robot.name),
        )
    heights = np.arange(1, _GROWING_SWING_COUNT + 1) / _GROWING_SWING_COUNT
    lows = heights * np.resize(_RETURN_SHARES, _GROWING_SWING_COUNT)
    # The fading swings begin at the low end.
    lows[-1] = 0.0
    knots = np.concatenate([[0.0], np.stack([heights, lows], axis=1).ravel()])
    knots_s = np.cumsum(np.abs(np.diff(knots, prepend=0.0))) / _GROWING_RANGES_PER_S
    time_s = np.arange(round((knots_s[-1] + _FADING_S + _RANDOM_S) * RATE_HZ)) / RATE_HZ
    swings = np.interp(time_s, knots_s, knots)
    since_growing_s = time_s - knots_s[-1]
    wave = np.cos(2.0 * np.pi * _FADING_HZ * since_growing_s)
    fading = 0.5 - 0.5 * (1.0 - since_growing_s / (1.1 * _FADING_S)) * wave
    swings = np.where(since_growing_s < 0.0, swings, fading)
    is_random = since_growing_s >= _FADING_S
    swings[is_random] = _draw_random_moves(time_s[is_random], rng)
    shares = _EDGE_SHARE + (1.0 - 2.0 * _EDGE_SHARE) * swings
    window = np.hanning(round(_SMOOTHING_S * RATE_HZ) | 1)
    padded = np.pad(shares, len(window) // 2, mode="edge")
    smooth = np.convolve(padded, window / window.sum(), "valid")
    command = axis_model.range[0] + axis_model.span * smooth
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: robot.unit(axis) or "m"})


def _draw_random_moves(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    places, arrivals_s = [0.5], [time_s[0]]
    while arrivals_s[-1] < time_s[-1]:
        places.append(float(rng.uniform(0.0, 1.0)))
        speed = float(np.exp(rng.uniform(*np.log(_RANDOM_RANGES_PER_S))))
        arrivals_s.append(arrivals_s[-1] + _MIN_MOVE_S + abs(places[-1] - places[-2]) / speed)
    return np.asarray(np.interp(time_s, arrivals_s, places), dtype=np.float64)
