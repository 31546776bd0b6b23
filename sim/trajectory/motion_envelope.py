"""The motion that records show: travel, speed and acceleration of each axis.

A command is only a request. Where it jumps from one row to the next, its speed depends on the rows
and not on the machine, so a record shows only the speed and the acceleration that its command and
its measured motion both reach. Readings are noisy and rounded. They are taken over the shortest
window in which noise and rounding contribute at most ``ROUNDING_SHARE``. A staircase thus shows how
fast the machine went from step to step; without a reading it shows its average speed, if it has
enough steps, and otherwise none.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from types import MappingProxyType
from typing import NamedTuple, Self

import numpy as np
from scipy.ndimage import median_filter

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import with_limits
from rotemina.sim.trajectory.speed_and_acceleration import ROUNDING_SHARE, second_differences

_LEAST_ROWS = 5
_SPIKE_ROWS = 5  # width of the median filter: a dropout of two rows is no motion
_DEVIATIONS = 4.0  # of the noise, beyond which hardly any reading is off
_DIFFERENCES = 4  # order at which slow motion has vanished and noise is left
_GAIN_OF_NOISE = sqrt(70.0)  # of the fourth difference: its coefficients are 1, 4, 6, 4, 1
_MEDIAN_TO_DEVIATION = 1.0 / 0.6745  # of normal noise


@dataclass(frozen=True, slots=True)
class AxisMotion:
    """Travel of one axis, m or rad, and the greatest speed and acceleration, per s and per s²."""

    low: float
    high: float
    speed: float
    acceleration: float

    @property
    def has_motion(self) -> bool:
        """Whether the axis was seen to move."""
        return self.high > self.low and self.speed > 0.0 and self.acceleration > 0.0


@dataclass(frozen=True, slots=True, eq=False)
class MotionEnvelope:
    """The motion of each commanded axis that at least one of several records shows."""

    axes: Mapping[str, AxisMotion]

    @classmethod
    def of(cls, records: Sequence[Record]) -> Self:
        """Find the envelope of records; an axis without commands is not in it."""
        shown: dict[str, list[AxisMotion]] = {}
        for record in records:
            for axis in record.axes:
                if record.has(axis, Tap.CMD):
                    shown.setdefault(axis, []).append(_motion(record, axis))
        return cls(
            MappingProxyType(
                {
                    axis: AxisMotion(
                        min(one.low for one in motions),
                        max(one.high for one in motions),
                        max(one.speed for one in motions),
                        max(one.acceleration for one in motions),
                    )
                    for axis, motions in shown.items()
                }
            )
        )

    def has_motion(self, axis: str) -> bool:
        """Whether a record shows an axis in motion."""
        return axis in self.axes and self.axes[axis].has_motion

    def narrow(self, robot: Robot) -> Robot:
        """Return a robot that is limited to the speeds and accelerations of the records."""
        moving = [axis for axis in robot.axes if self.has_motion(axis)]
        return with_limits(
            robot,
            {axis: self.axes[axis].speed for axis in moving},
            {axis: self.axes[axis].acceleration for axis in moving},
        )


class _Rates(NamedTuple):
    """A speed and an acceleration, SI; 0 where none is certain."""

    speed: float
    acceleration: float


def _motion(record: Record, axis: str) -> AxisMotion:
    time_s, command = record.time_s, record.signal(axis, Tap.CMD)
    speed = acceleration = 0.0
    if len(time_s) >= _LEAST_ROWS:
        asked = _Rates(_speed(time_s, command, 1), _acceleration(time_s, command, 1))
        certain = _certain_rates(time_s, command, _error(command))
        tap = next((tap for tap in (Tap.REF, Tap.MEAS) if record.has(axis, tap)), None)
        if tap is not None:
            reading = record.signal(axis, tap)
            smooth = median_filter(reading, _SPIKE_ROWS, mode="nearest")
            measured = _certain_rates(time_s, smooth, _error(reading))
            certain = _Rates(*(of or else_ for of, else_ in zip(measured, certain, strict=True)))
        speed = min(asked.speed, certain.speed)
        acceleration = min(asked.acceleration, certain.acceleration)
    return AxisMotion(float(command.min()), float(command.max()), speed, acceleration)


def _certain_rates(time_s: FloatArray, signal: FloatArray, error: float) -> _Rates:
    """Return the rates over the shortest windows in which the error of a value weighs little."""
    speed = acceleration = 0.0
    rows = 1
    while 2 * rows < len(time_s) and not (speed and acceleration):
        window_s = float(np.min(time_s[rows:] - time_s[:-rows]))
        speed = speed or _if_certain(_speed(time_s, signal, rows), 2.0 * error / window_s)
        acceleration = acceleration or _if_certain(
            _acceleration(time_s, signal, rows), 4.0 * error / window_s**2
        )
        rows *= 2
    return _Rates(speed, acceleration)


def _if_certain(value: float, error: float) -> float:
    return value if error <= ROUNDING_SHARE * value else 0.0


def _speed(time_s: FloatArray, signal: FloatArray, rows: int) -> float:
    change = np.abs(signal[rows:] - signal[:-rows])
    return float(np.max(change / (time_s[rows:] - time_s[:-rows])))


def _acceleration(time_s: FloatArray, signal: FloatArray, rows: int) -> float:
    return float(np.max(np.abs(second_differences(time_s, signal, rows).value)))


def _error(signal: FloatArray) -> float:
    """Return by how much a value may be off: by half a rounding step, or by noise."""
    steps = np.abs(np.diff(signal))
    arithmetic = 8.0 * float(np.finfo(np.float64).eps) * float(np.abs(signal).max())
    resolution = float(np.min(steps, where=steps > arithmetic, initial=np.inf))
    noise = _MEDIAN_TO_DEVIATION * float(np.median(np.abs(np.diff(signal, _DIFFERENCES))))
    rounding = resolution / 2.0 if np.isfinite(resolution) else 0.0
    return max(rounding, _DEVIATIONS * noise / _GAIN_OF_NOISE)
