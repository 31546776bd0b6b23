"""Monitoring of the deviation of readings from the model.

A large deviation that lasts stops the motion.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, format_rounded, message
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact

# A deviation stops the motion only if it lasts this long, so that one outlier does not stop it.
MIN_DEVIATION_S = 0.02


@dataclass(frozen=True, slots=True)
class PlaybackGap:
    """Root mean square and peak of the deviation of readings from the model, m or rad."""

    rms: float
    peak: float


class DeviationWatch:
    """Compares readings with the model, batch by batch, during a playback.

    Parameters
    ----------
    robot : Robot
    bounds : mapping axis -> float
        Largest permitted deviation, m or rad. Axes without a bound are only compared.

    Raises
    ------
    InputError
        If the robot has no such axis, or a bound is not above 0.
    """

    def __init__(self, robot: Robot, bounds: Mapping[str, float] = MappingProxyType({})) -> None:
        for axis, bound in bounds.items():
            if axis not in robot.axes:
                raise InputError("deviation: there is no axis {axis}", axis=repr(axis))
            if not bound > 0.0:
                raise InputError(
                    "deviation: axis {axis}: the bound {bound} must be above 0",
                    axis=AxisName(axis),
                    bound=format_rounded(bound, 6),
                )
        self._robot = robot
        self._axes = tuple(robot.axes)
        self._bounds = np.array([bounds.get(axis, np.inf) for axis in self._axes])
        # Device time since which each axis has exceeded its bound; NaN within the bound.
        self._exceeded_since_s = np.full(len(self._axes), np.nan)
        self._square_sum = np.zeros(len(self._axes))
        self._peak = np.zeros(len(self._axes))
        self._sample_count = 0

    @property
    def bounds(self) -> dict[str, float]:
        """The bound of each axis that has one, m or rad."""
        pairs = zip(self._axes, self._bounds.tolist(), strict=True)
        return {axis: bound for axis, bound in pairs if np.isfinite(bound)}

    @property
    def gaps(self) -> dict[str, PlaybackGap]:
        """Deviation of each axis from the model; empty before the first sample.

        An axis whose model had no finite output is left out.
        """
        if not self._sample_count:
            return {}
        rms = np.sqrt(self._square_sum / self._sample_count)
        pairs = zip(self._axes, rms.tolist(), self._peak.tolist(), strict=True)
        return {
            axis: PlaybackGap(axis_rms, peak)
            for axis, axis_rms, peak in pairs
            if np.isfinite(axis_rms)
        }

    def restart(self) -> None:
        """Forget how long an axis has exceeded its bound, for example after a pause."""
        self._exceeded_since_s[:] = np.nan

    def add(
        self, samples: DeviceSamples, model: FloatArray, nominal: FloatArray | None = None
    ) -> str | None:
        """Add samples and model outputs (n, axes).

        Return an error message if an axis has exceeded its bound for too long. The gaps refer to
        the model in use. The bounds also apply to the nominal model, so that no choice of another
        model loosens them.
        """
        if not len(samples):
            return None
        deviation = np.abs(samples.measured - model)
        self._square_sum += (deviation**2).sum(axis=0)
        self._peak = np.maximum(self._peak, deviation.max(axis=0))
        self._sample_count += len(samples)
        if nominal is not None:
            deviation = np.fmax(deviation, np.abs(samples.measured - nominal))
        is_exceeded = deviation > self._bounds
        if not is_exceeded.any() and np.isnan(self._exceeded_since_s).all():
            return None
        # Go row by row, because a batch may contain the end of one excess and the start of another.
        for row in range(len(samples)):
            time_s = float(samples.device_time_s[row])
            has_begun = is_exceeded[row] & np.isnan(self._exceeded_since_s)
            self._exceeded_since_s[has_begun] = time_s
            self._exceeded_since_s[~is_exceeded[row]] = np.nan
            lasting_columns = np.flatnonzero(time_s - self._exceeded_since_s >= MIN_DEVIATION_S)
            if len(lasting_columns):
                return self._format_excess(
                    int(lasting_columns[0]), float(deviation[row, lasting_columns[0]])
                )
        return None

    def _format_excess(self, column: int, deviation: float) -> str:
        axis, bound = self._axes[column], float(self._bounds[column])
        unit = self._robot.unit(axis) or ""
        return message(
            "engine",
            "axis {axis} deviates from the model by {deviation} for more than {time} ms; the "
            "bound is {bound}",
        ).fill(
            axis=AxisName(axis),
            deviation=format_exact(deviation, unit),
            time=1e3 * MIN_DEVIATION_S,
            bound=format_exact(bound, unit),
        )
