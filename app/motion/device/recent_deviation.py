"""Recent deviation of readings from commands, which the tip's bounds take into account."""

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot import Axis, Robot

# The median of five samples is unaffected by two outliers.
_MEDIAN_SAMPLE_COUNT = 5
# Bound of a sensor's noise, in standard deviations. One step of its resolution is added.
_NOISE_BOUND_SIGMAS = 6.0


class ReadingDeviation:
    """Measures the deviation of readings from the nominal model; used only by the worker.

    Attributes
    ----------
    present : (axes,)
        Current deviation, m or rad: the median difference of the latest readings from the
        prediction of the nominal model, reduced by the bound of the noise. The prediction includes
        running moves, so these cause no deviation. Replaced as a whole, so any thread may read it.
    """

    def __init__(self, robot: Robot) -> None:
        axes = robot.axes.values()
        self._noise = np.array([_compute_noise_bound(axis) for axis in axes])
        self._offset = np.array([axis.offset for axis in axes])
        self.restart()

    def restart(self) -> None:
        """Forget past readings."""
        self._recent_errors = np.zeros((0, len(self._noise)))
        self.current_deviation: FloatArray = np.zeros(len(self._noise))

    def follow(self, samples: DeviceSamples, model: FloatArray) -> None:
        """Add samples and the readings (n, axes) that the nominal model predicts.

        Where the prediction is NaN, the command is expected instead.
        """
        if not len(samples):
            return
        expected = np.where(np.isfinite(model), model, samples.command + self._offset)
        errors = samples.measured - expected
        self._recent_errors = np.concatenate([self._recent_errors, errors])[-_MEDIAN_SAMPLE_COUNT:]
        median_error = np.median(self._recent_errors, axis=0)
        # Only the part beyond the noise counts as a deviation.
        self.current_deviation = np.sign(median_error) * np.maximum(
            np.abs(median_error) - self._noise, 0.0
        )


def _compute_noise_bound(axis: Axis) -> float:
    sensor = axis.sensor
    rounding = 1e-9 * axis.span
    return (
        rounding
        if sensor is None
        else rounding + _NOISE_BOUND_SIGMAS * sensor.noise_rms + sensor.resolution
    )
