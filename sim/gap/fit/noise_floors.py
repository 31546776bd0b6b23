"""The noise floor of each tap of a record.

It is declared, measured at rest or between periods, or else estimated from the part of the signal
that neighbouring samples do not predict.
"""

from collections.abc import Mapping
from math import comb

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison import find_noise_floor
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot, StepperAxis

_ORDER = 6  # of the differences, to which motion is smooth
_BLOCK_ROWS = 100  # fewer in short records
_LEAST_BLOCK_ROWS = 10
_LEAST_BLOCKS = 5
_ROUNDING = 1e-12  # of a signal's size: what is less than that was computed
_GRID_ROWS = 20_000  # in which the steps of a signal are looked for
_TAPS = (Tap.U, Tap.REF, Tap.MEAS)


def floors(robot: Robot, record: Record, axis: str) -> Mapping[Tap, float]:
    """Return the floor, SI, of each measured tap that responds and whose floor can be known.

    Under a controller the reading and ``u`` are one measurement, and ``u`` shows more of it:
    without a declared sensor, the reading is left out.
    """
    found: dict[Tap, float] = {}
    for tap in _TAPS:
        if not record.has(axis, tap) or (tap is Tap.U and not _answers_u(robot, axis, record)):
            continue
        floor, source = find_noise_floor(robot, record, axis, tap)
        signal = record.signal(axis, tap)
        if source != "declared" and (tap is not Tap.U or record.closed_loop):
            # A held axis may shake, or be on its way: that is no noise of its sensor.
            known = [level for level in (floor, unforetold(signal)) if level is not None]
            floor = min(known, default=None)
        if floor is None:
            continue
        if tap is not Tap.MEAS:  # that a sensor reads in coarser steps than declared is an effect
            floor = float(np.hypot(floor, _grid(signal) / np.sqrt(12.0)))
        found[tap] = floor
    controlled = record.closed_loop and Tap.U in found
    if controlled and robot.axes[axis].sensor is None:
        found.pop(Tap.MEAS, None)
    return found


def unforetold(signal: FloatArray) -> float | None:
    """Return the rms of white noise in a signal (n,), by its differences of a high order.

    Motion is smooth to them in most blocks of rows, of which the median is taken; a difference of
    order k multiplies the variance of white noise by ``(2k choose k)`` (Hall, Kay, Titterington,
    Biometrika 77 (1990) 521-528). None if there are too few rows, or the signal was computed.
    """
    differences = np.diff(signal, _ORDER) / np.sqrt(comb(2 * _ORDER, _ORDER))
    rows = min(_BLOCK_ROWS, len(differences) // _LEAST_BLOCKS)
    if rows < _LEAST_BLOCK_ROWS:
        return None
    blocks = len(differences) // rows
    squares = differences[: blocks * rows].reshape(blocks, rows) ** 2
    level = float(np.sqrt(np.median(squares.mean(axis=1))))
    return level if level > _ROUNDING * float(np.abs(signal).max()) else None


def _answers_u(robot: Robot, axis: str, record: Record) -> bool:
    """Whether ``u`` is an answer of the model, and does not drive it."""
    described = robot.axes[axis]
    if isinstance(described, StepperAxis):
        return False
    return described.kind == "piezo" or record.closed_loop


def _grid(signal: FloatArray) -> float:
    """Return the step of the written numbers of a signal, 0 if there is none."""
    levels = np.unique(signal[:_GRID_ROWS])
    if len(levels) < 3:
        return 0.0
    step = float(np.diff(levels).min())
    off = levels / step - np.rint(levels / step)
    return step if float(np.abs(off).max()) < 0.05 else 0.0
