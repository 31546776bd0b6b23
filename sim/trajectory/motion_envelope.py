"""The motion that records show: travel, speed and acceleration of each axis.

A command is only a request. If it jumps from one row to the next, its speed depends on the rows and
not on the machine. Therefore a record shows only the speed and the acceleration that both its
command and its measured motion reach. Readings are noisy and rounded, so their rates are computed
over the shortest window in which noise and rounding contribute at most ``MAX_ROUNDING_RATIO``. From
a record of a staircase, this gives the speed of the machine from step to step. Without a reading,
the record gives the average speed if it has enough steps, and otherwise no speed.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from types import MappingProxyType
from typing import NamedTuple, Self

import numpy as np
from scipy.ndimage import median_filter

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory.axis_limits import with_limits
from rotemina.sim.trajectory.speed_and_acceleration import (
    MAX_ROUNDING_RATIO,
    compute_second_differences,
)

_MIN_ROWS = 5
# Width of the median filter, which removes dropouts of up to two rows.
_SPIKE_ROWS = 5
# Noise rarely exceeds this many standard deviations.
_NOISE_DEVIATIONS = 4.0
# In differences of this order, slow motion has vanished and only noise remains.
_NOISE_DIFFERENCE_ORDER = 4
# Gain of the fourth difference for noise, from its coefficients 1, 4, 6, 4, 1.
_NOISE_DIFFERENCE_GAIN = sqrt(70.0)
# Standard deviation over median absolute value of normal noise.
_MEDIAN_TO_DEVIATION = 1.0 / 0.6745


@dataclass(frozen=True, slots=True)
class AxisMotion:
    """Travel of one axis, m or rad, and its maximum speed and acceleration, per s and per s²."""

    low: float
    high: float
    speed: float
    acceleration: float

    @property
    def has_motion(self) -> bool:
        """Whether the records show motion of the axis."""
        return self.high > self.low and self.speed > 0.0 and self.acceleration > 0.0


@dataclass(frozen=True, slots=True, eq=False)
class MotionEnvelope:
    """The envelope of the motion in several records, for each commanded axis."""

    axes: Mapping[str, AxisMotion]

    @classmethod
    def of(cls, records: Sequence[Record]) -> Self:
        """Return the envelope of records, without axes that have no commands."""
        motions_by_axis: dict[str, list[AxisMotion]] = {}
        for record in records:
            for axis in record.axes:
                if record.has(axis, Tap.CMD):
                    motions_by_axis.setdefault(axis, []).append(_find_motion(record, axis))
        return cls(
            MappingProxyType(
                {
                    axis: AxisMotion(
                        min(motion.low for motion in motions),
                        max(motion.high for motion in motions),
                        max(motion.speed for motion in motions),
                        max(motion.acceleration for motion in motions),
                    )
                    for axis, motions in motions_by_axis.items()
                }
            )
        )

    def has_motion(self, axis: str) -> bool:
        """Return whether a record shows motion of an axis."""
        return axis in self.axes and self.axes[axis].has_motion

    def narrow(self, robot: Robot) -> Robot:
        """Return a robot with its speeds and accelerations limited to those of the records."""
        moving_axes = [axis for axis in robot.axes if self.has_motion(axis)]
        return with_limits(
            robot,
            {axis: self.axes[axis].speed for axis in moving_axes},
            {axis: self.axes[axis].acceleration for axis in moving_axes},
        )


class _MotionRates(NamedTuple):
    """A speed and an acceleration, SI; 0 if the value is too uncertain."""

    speed: float
    acceleration: float


def _find_motion(record: Record, axis: str) -> AxisMotion:
    time_s, command = record.time_s, record.signal(axis, Tap.CMD)
    speed = acceleration = 0.0
    if len(time_s) >= _MIN_ROWS:
        commanded = _MotionRates(
            _find_max_speed(time_s, command, 1), _find_max_acceleration(time_s, command, 1)
        )
        reliable = _find_reliable_rates(time_s, command, _estimate_value_error(command))
        tap = next((tap for tap in (Tap.REF, Tap.MEAS) if record.has(axis, tap)), None)
        if tap is not None:
            reading = record.signal(axis, tap)
            filtered = median_filter(reading, _SPIKE_ROWS, mode="nearest")
            measured = _find_reliable_rates(time_s, filtered, _estimate_value_error(reading))
            reliable = _MotionRates(
                *(
                    reading_rate or command_rate
                    for reading_rate, command_rate in zip(measured, reliable, strict=True)
                )
            )
        speed = min(commanded.speed, reliable.speed)
        acceleration = min(commanded.acceleration, reliable.acceleration)
    return AxisMotion(float(command.min()), float(command.max()), speed, acceleration)


def _find_reliable_rates(time_s: FloatArray, signal: FloatArray, error: float) -> _MotionRates:
    """Return the rates over the shortest windows in which the error of a value is small."""
    speed = acceleration = 0.0
    rows = 1
    while 2 * rows < len(time_s) and not (speed and acceleration):
        window_s = float(np.min(time_s[rows:] - time_s[:-rows]))
        speed = speed or _zero_if_uncertain(
            _find_max_speed(time_s, signal, rows), 2.0 * error / window_s
        )
        acceleration = acceleration or _zero_if_uncertain(
            _find_max_acceleration(time_s, signal, rows), 4.0 * error / window_s**2
        )
        rows *= 2
    return _MotionRates(speed, acceleration)


def _zero_if_uncertain(value: float, error: float) -> float:
    return value if error <= MAX_ROUNDING_RATIO * value else 0.0


def _find_max_speed(time_s: FloatArray, signal: FloatArray, rows: int) -> float:
    change = np.abs(signal[rows:] - signal[:-rows])
    return float(np.max(change / (time_s[rows:] - time_s[:-rows])))


def _find_max_acceleration(time_s: FloatArray, signal: FloatArray, rows: int) -> float:
    return float(np.max(np.abs(compute_second_differences(time_s, signal, rows).value)))


def _estimate_value_error(signal: FloatArray) -> float:
    """Return the error of a value: half a rounding step, or the noise if that is larger."""
    steps = np.abs(np.diff(signal))
    float_rounding = 8.0 * float(np.finfo(np.float64).eps) * float(np.abs(signal).max())
    resolution = float(np.min(steps, where=steps > float_rounding, initial=np.inf))
    noise = _MEDIAN_TO_DEVIATION * float(
        np.median(np.abs(np.diff(signal, _NOISE_DIFFERENCE_ORDER)))
    )
    rounding = resolution / 2.0 if np.isfinite(resolution) else 0.0
    return max(rounding, _NOISE_DEVIATIONS * noise / _NOISE_DIFFERENCE_GAIN)
