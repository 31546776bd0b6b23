"""Recent deviation of readings from commands, which bounds take into account."""

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Axis, Robot

_MEDIAN = 5  # samples; two outliers among them change nothing
_SURE = 6.0  # standard deviations of a sensor's noise, beside a step of it


class ReadingDeviation:
    """Follows samples on the worker's thread; ``now`` is replaced as a whole, for any thread.

    Attributes
    ----------
    now : (axes,)
        Median difference of the latest readings from the nominal model's answers to the commands
        that acted, m or rad, less what is noise: a move that is under way deviates by nothing.
    """

    def __init__(self, robot: Robot) -> None:
        axes = robot.axes.values()
        self._noise = np.array([_noise(axis) for axis in axes])
        self._offset = np.array([axis.offset for axis in axes])
        self.restart()

    def restart(self) -> None:
        """Forget past readings."""
        self._recent = np.zeros((0, len(self._noise)))
        self.now: FloatArray = np.zeros(len(self._noise))

    def follow(self, samples: Samples, model: FloatArray) -> None:
        """Take samples and the nominal model's readings (n, axes) for them; NaN: none."""
        if not len(samples):
            return
        expected = np.where(np.isfinite(model), model, samples.command + self._offset)
        error = samples.measured - expected
        self._recent = np.concatenate([self._recent, error])[-_MEDIAN:]
        middle = np.median(self._recent, axis=0)
        self.now = np.sign(middle) * np.maximum(np.abs(middle) - self._noise, 0.0)


def _noise(axis: Axis) -> float:
    sensor = axis.sensor
    slack = 1e-9 * axis.span
    return slack if sensor is None else slack + _SURE * sensor.noise_rms + sensor.resolution
