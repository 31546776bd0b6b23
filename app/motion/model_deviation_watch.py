"""Supervision of the gap between model and machine: a large lasting one stops the motion."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.robot.model import Robot

LASTING_S = 0.02  # an outlier of a sensor is no reason to stop


@dataclass(frozen=True, slots=True)
class Gap:
    """How far readings were from the model: root mean square and largest, m or rad."""

    rms: float
    peak: float


class DeviationWatch:
    """Compares readings with the nominal model's, portion by portion, while something plays.

    Parameters
    ----------
    robot : Robot
    bounds : mapping axis -> float
        The greatest deviation that is no reason to stop, m or rad; axes without one are only
        compared.

    Raises
    ------
    InputError
        If there is no such axis, or a bound is not above 0.
    """

    def __init__(self, robot: Robot, bounds: Mapping[str, float] = MappingProxyType({})) -> None:
        for axis, bound in bounds.items():
            if axis not in robot.axes:
                raise InputError(
                    message("engine", "deviation: there is no axis {axis}").fill(axis=repr(axis))
                )
            if not bound > 0.0:
                raise InputError(
                    message(
                        "engine", "deviation: axis {axis}: the bound {bound} must be above 0"
                    ).fill(axis=AxisName(axis), bound=rounded(bound, 6))
                )
        self._robot = robot
        self._axes = tuple(robot.axes)
        self._bounds = np.array([bounds.get(axis, np.inf) for axis in self._axes])
        self._since_s = np.full(len(self._axes), np.nan)  # device time; NaN within the bound
        self._squares = np.zeros(len(self._axes))
        self._peak = np.zeros(len(self._axes))
        self._count = 0

    @property
    def bounds(self) -> dict[str, float]:
        """The bound of each axis that has one, m or rad."""
        pairs = zip(self._axes, self._bounds.tolist(), strict=True)
        return {axis: bound for axis, bound in pairs if np.isfinite(bound)}

    @property
    def gaps(self) -> dict[str, Gap]:
        """How far model and machine have been apart, of each axis; empty before the first sample.

        An axis whose model had no finite answer is left out.
        """
        if not self._count:
            return {}
        rms = np.sqrt(self._squares / self._count)
        pairs = zip(self._axes, rms.tolist(), self._peak.tolist(), strict=True)
        return {axis: Gap(one, peak) for axis, one, peak in pairs if np.isfinite(one)}

    def restart(self) -> None:
        """Forget for how long an axis has been beyond its bound, as after a pause."""
        self._since_s[:] = np.nan

    def add(
        self, samples: Samples, model: FloatArray, nominal: FloatArray | None = None
    ) -> str | None:
        """Add samples and the models' answers (n, axes); say which axis exceeds its bound, if any.

        The gap is that of the model in use. The bound also holds against the nominal model, so
        another model never widens it.
        """
        if not len(samples):
            return None
        deviation = np.abs(samples.measured - model)
        self._squares += (deviation**2).sum(axis=0)
        self._peak = np.maximum(self._peak, deviation.max(axis=0))
        self._count += len(samples)
        if nominal is not None:
            deviation = np.fmax(deviation, np.abs(samples.measured - nominal))
        beyond = deviation > self._bounds
        if not beyond.any() and np.isnan(self._since_s).all():
            return None
        for row in range(len(samples)):
            time_s = float(samples.device_time_s[row])
            begun = beyond[row] & np.isnan(self._since_s)
            self._since_s[begun] = time_s
            self._since_s[~beyond[row]] = np.nan
            lasting = np.flatnonzero(time_s - self._since_s >= LASTING_S)
            if len(lasting):
                return self._excess(int(lasting[0]), float(deviation[row, lasting[0]]))
        return None

    def _excess(self, column: int, deviation: float) -> str:
        axis, bound = self._axes[column], float(self._bounds[column])
        unit = self._robot.unit(axis) or ""
        return message(
            "engine",
            "axis {axis} deviates from the model by {deviation} for more than {time} ms; the "
            "bound is {bound}",
        ).fill(
            axis=AxisName(axis),
            deviation=exact(deviation, unit),
            time=1e3 * LASTING_S,
            bound=exact(bound, unit),
        )
