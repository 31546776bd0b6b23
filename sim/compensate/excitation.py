"""A motion that shows an axis' loops of all sizes, over nearly the whole range.

Swings grow from the low end first, back to some way above it in turn: an axis that has not been at
its high end turns otherwise than one that has, and an inverse begins with a rise from the low end.
Then swings fade around the middle, and random moves come at random speeds.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import PiezoAxis, Robot

RATE_HZ = 2000.0
_EDGE = 0.02  # of the range, kept free at either end
_FADING_S, _RANDOM_S = 8.0, 14.0
_FADING_HZ = 1.0
_SWINGS, _BACK = 14, (0.0, 0.5, 0.25)  # how many grow, and to what share of each it comes back
_GROWING_SPEED = 1.5  # ranges per second
_SPEEDS = (0.3, 20.0)  # ranges per second, of random moves
_SMOOTH_S = 0.04  # over which corners are rounded, so that the resonance stays quiet
_LEAST_S = 0.02  # of a move


def excitation(robot: Robot, axis: str, rng: np.random.Generator) -> Record:
    """Return commands of one piezo axis: swings that fade, then random moves of random speed.

    Raises
    ------
    CompensationError
        If the robot has no such piezo axis.
    """
    said = robot.axes.get(axis)
    if not isinstance(said, PiezoAxis):
        raise CompensationError(
            message("engine", "axis {axis}: robot {name} has no such piezo axis").fill(
                axis=repr(axis), name=repr(robot.name)
            )
        )
    heights = np.arange(1, _SWINGS + 1) / _SWINGS
    lows = heights * np.resize(_BACK, _SWINGS)
    lows[-1] = 0.0  # where fading begins
    knots = np.concatenate([[0.0], np.stack([heights, lows], axis=1).ravel()])
    reached_s = np.cumsum(np.abs(np.diff(knots, prepend=0.0))) / _GROWING_SPEED
    time_s = np.arange(round((reached_s[-1] + _FADING_S + _RANDOM_S) * RATE_HZ)) / RATE_HZ
    swings = np.interp(time_s, reached_s, knots)
    since_s = time_s - reached_s[-1]
    wave = np.cos(2.0 * np.pi * _FADING_HZ * since_s)
    fading = 0.5 - 0.5 * (1.0 - since_s / (1.1 * _FADING_S)) * wave
    swings = np.where(since_s < 0.0, swings, fading)
    random = since_s >= _FADING_S
    swings[random] = _random_moves(time_s[random], rng)
    shares = _EDGE + (1.0 - 2.0 * _EDGE) * swings
    window = np.hanning(round(_SMOOTH_S * RATE_HZ) | 1)
    padded = np.pad(shares, len(window) // 2, mode="edge")
    smooth = np.convolve(padded, window / window.sum(), "valid")
    command = said.range[0] + said.span * smooth
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: robot.unit(axis) or "m"})


def _random_moves(time_s: FloatArray, rng: np.random.Generator) -> FloatArray:
    places, at_s = [0.5], [time_s[0]]
    while at_s[-1] < time_s[-1]:
        places.append(float(rng.uniform(0.0, 1.0)))
        speed = float(np.exp(rng.uniform(*np.log(_SPEEDS))))
        at_s.append(at_s[-1] + _LEAST_S + abs(places[-1] - places[-2]) / speed)
    return np.asarray(np.interp(time_s, at_s, places), dtype=np.float64)
