"""Numerical descriptors of a residual, for a naive classifier."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from scipy.signal import periodogram
from scipy.stats import kurtosis

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.noise_floor import noise_floor
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import PiezoAxis, Robot

_BANDS_HZ = (0.0, 2.0, 20.0, 100.0, np.inf)
_TINY = 1e-12


def gap_in_floors(robot: Robot, records: Sequence[Record], axis: str) -> float:
    """Return the rms of real minus nominal reading over its floor, means removed."""
    power = [float(np.mean(_residual(robot, record, axis) ** 2)) for record in records]
    return float(np.sqrt(np.mean(power)))


def features(robot: Robot, records: Sequence[Record], axis: str) -> FloatArray:
    """Return (f,) numbers that describe the residual of an axis over all records."""
    rows = np.array([_of_record(robot, record, axis) for record in records])
    piezo = float(isinstance(robot.axes[axis], PiezoAxis))
    return np.concatenate([rows.mean(axis=0), rows.max(axis=0), rows.min(axis=0), [piezo]])


def _residual(robot: Robot, record: Record, axis: str) -> FloatArray:
    model = nominal_response(robot, record).signal(axis, Tap.MEAS)
    gap = record.signal(axis, Tap.MEAS) - model
    floor = noise_floor(robot, record, axis, Tap.MEAS).rms or 1.0
    return np.asarray((gap - gap.mean()) / floor)


def _of_record(robot: Robot, record: Record, axis: str) -> list[float]:
    gap = _residual(robot, record, axis)
    command = _standard(record.signal(axis, Tap.CMD))
    speed = np.gradient(command)
    time_s = _standard(record.time_s)
    shapes = [command, command**2, command**3, speed, np.sign(speed), np.gradient(speed)]
    shapes += [time_s, np.sqrt(record.time_s - record.time_s[0])]
    others = [record.signal(a, Tap.CMD) for a in record.axes if a != axis]
    leaks = [_explained(gap, other) for other in others]
    return [
        float(np.log10(np.std(gap) + _TINY)),
        *(_explained(gap, shape) for shape in shapes),
        max(leaks, default=0.0),
        *_spectrum(gap, record.duration_s),
        float(np.log10(3.0 + kurtosis(gap))),
        *(_explained(gap[lag:], gap[:-lag]) for lag in (1, 10, 100)),
        _sensor_share(record, axis, gap),
    ]


def _standard(values: FloatArray) -> FloatArray:
    return np.asarray((values - values.mean()) / (values.std() + _TINY))


def _explained(gap: FloatArray, shape: FloatArray) -> float:
    """Return the squared correlation."""
    return float(np.mean(_standard(gap) * _standard(shape)) ** 2)


def _spectrum(gap: FloatArray, duration_s: float) -> list[float]:
    """Return the share of power in each band, and that of the strongest line."""
    hertz, power = periodogram(gap, (len(gap) - 1) / max(duration_s, _TINY))
    power = power / (power.sum() + _TINY)
    limits = np.searchsorted(hertz, _BANDS_HZ)
    shares = [float(power[low:high].sum()) for low, high in pairwise(limits)]
    return [*shares, float(power.max())]


def _sensor_share(record: Record, axis: str, gap: FloatArray) -> float:
    """Return how much of the gap lies behind the reference, 0.5 where there is none."""
    if not record.has(axis, Tap.REF):
        return 0.5
    behind = record.signal(axis, Tap.MEAS) - record.signal(axis, Tap.REF)
    return _explained(gap, behind)
