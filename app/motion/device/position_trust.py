"""Monitoring of whether the positions that a device reports can be trusted.

A position is in doubt when an axis is away from its command, or has an impossible reading.

One reading proves nothing. A limit counts as exceeded only if every sample has exceeded it for
:data:`MIN_VIOLATION_S`, so a single outlier neither locks motion nor raises an alarm. Readings are
compared with commands, never with a model: a deviation is dangerous even if a model explains it.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.messages import AxisName, message
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact

# Shortest time for which a limit must be exceeded.
MIN_VIOLATION_S = 0.05
CONNECTION_LOST = message("engine", "the connection was lost")
# Bound of a sensor's noise, in standard deviations. One step of its resolution is added.
_NOISE_BOUND_SIGMAS = 6.0
_BEYOND_RANGE = message("engine", "axis {axis} reads {much} beyond its range")
_TOO_FAR_BEYOND_RANGE = message(
    "engine", "axis {axis} reads {much} beyond its range; at most {most} is permitted"
)
_TOO_FAR_FROM_COMMAND = message(
    "engine", "axis {axis} reads {much} away from its command; at most {most} is permitted"
)


class PositionVerdict(NamedTuple):
    """Verdict on a batch of samples.

    ``lock`` is the reason to lock motion, and ``axis`` the axis that requires it; None and empty if
    motion is not locked. ``alarms`` are reported without locking motion.
    """

    lock_reason: str | None
    alarms: tuple[str, ...]
    axis: str = ""


class PositionWatch:
    """Checks the samples of one machine, batch by batch.

    Parameters
    ----------
    robot : Robot
        Provides the axes' ranges, sensors and
        :attr:`~rotemina.sim.robot.PiezoAxis.following_limit`.
    """

    def __init__(self, robot: Robot) -> None:
        axes = robot.axes.values()
        self._robot = robot
        self._offset = np.array([axis.offset for axis in axes], dtype=np.float64)
        self._low, self._high = np.array([axis.range for axis in axes], dtype=np.float64).T
        self._following_limit = np.array([axis.following_limit for axis in axes])
        self._noise = np.array(
            [
                _NOISE_BOUND_SIGMAS * axis.sensor.noise_rms + axis.sensor.resolution
                if axis.sensor
                else 0.0
                for axis in axes
            ]
        )
        self.restart()

    def restart(self) -> None:
        """Forget past samples; the next sample counts as the first."""
        # Device time since which each axis exceeds each of three limits: the following limit, the
        # range, and the range extended by the following limit. NaN within the limit.
        self._exceeded_since_s = np.full((3, len(self._low)), np.nan)
        self._is_alarmed = np.zeros(len(self._low), dtype=np.bool_)

    def judge(self, samples: DeviceSamples) -> PositionVerdict:
        """Return the verdict on the next samples."""
        if not len(samples):
            return PositionVerdict(None, ())
        measured = samples.measured - self._offset
        distance = np.abs(measured - samples.command)
        excess = np.maximum(self._low - measured, measured - self._high)
        slack = self._noise + 1e-9 * (self._high - self._low)
        sustained = [
            self._find_sustained(limit_index, samples.device_time_s, exceeds)
            for limit_index, exceeds in enumerate(
                (distance > self._following_limit, excess > slack, excess > self._following_limit)
            )
        ]
        deviates, is_outside, is_far_outside = sustained
        for column in np.flatnonzero(deviates | is_far_outside):
            name, unit = self._find_axis(int(column))
            template, amount = _TOO_FAR_FROM_COMMAND, float(distance[-1, column])
            if is_far_outside[column]:
                template, amount = _TOO_FAR_BEYOND_RANGE, float(excess[-1, column])
            limit = format_exact(float(self._following_limit[column]), unit)
            reason = template.fill(axis=AxisName(name), much=format_exact(amount, unit), most=limit)
            return PositionVerdict(reason, (), name)
        alarms = tuple(
            _BEYOND_RANGE.fill(
                axis=AxisName(name), much=format_exact(float(excess[-1, column]), unit)
            )
            for column in np.flatnonzero(is_outside & ~self._is_alarmed)
            for name, unit in [self._find_axis(int(column))]
        )
        # Each axis is reported once until it is back inside its range.
        self._is_alarmed = is_outside | (self._is_alarmed & (excess[-1] > 0.0))
        return PositionVerdict(None, alarms)

    def _find_axis(self, column: int) -> tuple[str, str]:
        name = tuple(self._robot.axes)[column]
        return name, self._robot.unit(name) or ""

    def _find_sustained(
        self, limit_index: int, time_s: FloatArray, exceeds: BoolArray
    ) -> BoolArray:
        """Return which axes (axes,) have exceeded a limit in every sample for long enough.

        ``exceeds`` (n, axes) says which samples exceed the limit number ``limit_index``.
        """
        is_sustained = np.zeros(exceeds.shape[1], dtype=np.bool_)
        has_exceeded = exceeds.any(axis=0)
        self._exceeded_since_s[limit_index, ~has_exceeded] = np.nan
        for column in np.flatnonzero(has_exceeded):
            rows_within = np.flatnonzero(~exceeds[:, column])
            first_excess = rows_within[-1] + 1 if len(rows_within) else 0
            if first_excess == len(exceeds):
                self._exceeded_since_s[limit_index, column] = np.nan
            elif len(rows_within) or np.isnan(self._exceeded_since_s[limit_index, column]):
                self._exceeded_since_s[limit_index, column] = time_s[first_excess]
            is_sustained[column] = (
                time_s[-1] - self._exceeded_since_s[limit_index, column] >= MIN_VIOLATION_S
            )
        return is_sustained


class PositionTrust:
    """Axes whose positions are in doubt; while there is any, motion is locked.

    An axis is trusted again when its limit switch has been found. All axes are trusted again when
    an operator who has looked at the machine confirms the positions. Only the session's worker uses
    this object.

    Parameters
    ----------
    robot : Robot
    """

    def __init__(self, robot: Robot) -> None:
        self._watch = PositionWatch(robot)
        self._doubtful_axes: frozenset[str] = frozenset()
        #: Why the position may be wrong; None while it is trusted.
        self.reason: str | None = None

    def restart(self) -> None:
        """Forget past readings, for example after a gap in the samples. Doubts remain."""
        self._watch.restart()

    def doubt(self, reason: str, axes: Iterable[str]) -> None:
        """Put the positions of axes in doubt. Only the first reason is reported."""
        self._doubtful_axes |= frozenset(axes)
        self.reason = self.reason or reason

    def judge(self, samples: DeviceSamples) -> tuple[str | None, tuple[str, ...]]:
        """Return the reason to stop the machine now, or None, and the alarms to report."""
        verdict = self._watch.judge(samples)
        if verdict.lock_reason is None:
            return None, verdict.alarms
        is_new = verdict.axis not in self._doubtful_axes
        self.doubt(verdict.lock_reason, (verdict.axis,))
        return verdict.lock_reason if is_new else None, verdict.alarms

    def trust_homed_axes(self, axes: Iterable[str]) -> None:
        """Trust axes again whose limit switches have been found."""
        self._doubtful_axes -= frozenset(axes)
        if not self._doubtful_axes:
            self.reason = None

    def confirm(self) -> None:
        """Trust all positions again after an operator has confirmed them."""
        self._doubtful_axes, self.reason = frozenset(), None
        self._watch.restart()
