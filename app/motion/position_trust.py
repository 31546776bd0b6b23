"""Trust in the device's position: supervision of readings, and what resolves a doubt.

A doubt comes from an axis away from its target, or with an impossible reading.

One reading proves nothing: a limit counts only if every sample has exceeded it for
:data:`LASTING_S`, so a single outlier neither locks nor alarms. Only command and reading are
compared, never a model: an explanation by a model does not make a machine safe.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.robot.model import Robot

LASTING_S = 0.05
LOST = message("engine", "the connection was lost")
_SURE = 6.0  # standard deviations of a sensor's noise, beside a step of it
_BEYOND = message("engine", "axis {axis} reads {much} beyond its range")
_FAR_BEYOND = message(
    "engine", "axis {axis} reads {much} beyond its range; at most {most} is permitted"
)
_APART = message(
    "engine", "axis {axis} reads {much} away from its command; at most {most} is permitted"
)


class Judgement(NamedTuple):
    """The result for a portion of samples: why motion must lock, and reasons only to report.

    ``axis`` is the axis that requires the lock; empty without one.
    """

    lock: str | None
    alarms: tuple[str, ...]
    axis: str = ""


class PositionWatch:
    """Judges the samples of one machine, portion by portion.

    Parameters
    ----------
    robot : Robot
        Its axes' ranges, sensors and :attr:`~rotemina.sim.robot.model.PiezoAxis.following`.
    """

    def __init__(self, robot: Robot) -> None:
        axes = robot.axes.values()
        self._robot = robot
        self._offset = np.array([axis.offset for axis in axes], dtype=np.float64)
        self._low, self._high = np.array([axis.range for axis in axes], dtype=np.float64).T
        self._following = np.array([axis.following for axis in axes])
        self._noise = np.array(
            [
                _SURE * axis.sensor.noise_rms + axis.sensor.resolution if axis.sensor else 0.0
                for axis in axes
            ]
        )
        self.restart()

    def restart(self) -> None:
        """Forget past samples: the next sample is the first."""
        self._since = np.full(
            (3, len(self._low)), np.nan
        )  # following, beyond the range, far beyond
        self._alarmed = np.zeros(len(self._low), dtype=np.bool_)

    def judge(self, samples: Samples) -> Judgement:
        """Return what samples show that follow those judged before; SI units."""
        if not len(samples):
            return Judgement(None, ())
        measured = samples.measured - self._offset
        apart = np.abs(measured - samples.command)
        beyond = np.maximum(self._low - measured, measured - self._high)
        slack = self._noise + 1e-9 * (self._high - self._low)
        found = [
            self._lasting(row, samples.device_time_s, off)
            for row, off in enumerate(
                (apart > self._following, beyond > slack, beyond > self._following)
            )
        ]
        follows, outside, far = found
        for column in np.flatnonzero(follows | far):
            name, unit = self._named(int(column))
            said, much = _APART, float(apart[-1, column])
            if far[column]:
                said, much = _FAR_BEYOND, float(beyond[-1, column])
            most = exact(float(self._following[column]), unit)
            told = said.fill(axis=AxisName(name), much=exact(much, unit), most=most)
            return Judgement(told, (), name)
        alarms = tuple(
            _BEYOND.fill(axis=AxisName(name), much=exact(float(beyond[-1, column]), unit))
            for column in np.flatnonzero(outside & ~self._alarmed)
            for name, unit in [self._named(int(column))]
        )
        # Told once until the axis is back in.
        self._alarmed = outside | (self._alarmed & (beyond[-1] > 0.0))
        return Judgement(None, alarms)

    def _named(self, column: int) -> tuple[str, str]:
        name = tuple(self._robot.axes)[column]
        return name, self._robot.unit(name) or ""

    def _lasting(self, row: int, time_s: FloatArray, off: BoolArray) -> BoolArray:
        """Return for which axes (axes,) each sample has been ``off`` (n, axes) for long enough."""
        lasting = np.zeros(off.shape[1], dtype=np.bool_)
        some = off.any(axis=0)
        self._since[row, ~some] = np.nan
        for column in np.flatnonzero(some):
            good = np.flatnonzero(~off[:, column])
            first = good[-1] + 1 if len(good) else 0
            if first == len(off):
                self._since[row, column] = np.nan
            elif len(good) or np.isnan(self._since[row, column]):
                self._since[row, column] = time_s[first]
            lasting[column] = time_s[-1] - self._since[row, column] >= LASTING_S
        return lasting


class PositionTrust:
    """Doubt about axes; while there is any, motion is locked.

    An axis is believed again when its switch was found, or when someone who has looked confirms
    all of them. Used on the worker's thread.

    Parameters
    ----------
    robot : Robot
    """

    def __init__(self, robot: Robot) -> None:
        self._watch = PositionWatch(robot)
        self._doubtful: frozenset[str] = frozenset()
        #: Why the position may be wrong; None while it is believed.
        self.reason: str | None = None

    def restart(self) -> None:
        """Forget past readings, as after a gap; a doubt stays."""
        self._watch.restart()

    def doubt(self, reason: str, axes: Iterable[str]) -> None:
        """Distrust the positions of axes; the first reason is the reported one."""
        self._doubtful |= frozenset(axes)
        self.reason = self.reason or reason

    def judge(self, samples: Samples) -> tuple[str | None, tuple[str, ...]]:
        """Return why the machine must stop now, if it must, and reasons only to report."""
        judged = self._watch.judge(samples)
        if judged.lock is None:
            return None, judged.alarms
        news = judged.axis not in self._doubtful
        self.doubt(judged.lock, (judged.axis,))
        return judged.lock if news else None, judged.alarms

    def homed(self, axes: Iterable[str]) -> None:
        """Believe axes whose switches were found."""
        self._doubtful -= frozenset(axes)
        if not self._doubtful:
            self.reason = None

    def confirm(self) -> None:
        """Trust all positions, on an operator's confirmation."""
        self._doubtful, self.reason = frozenset(), None
        self._watch.restart()
