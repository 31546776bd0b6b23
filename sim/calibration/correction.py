"""Causal correction of a sensor's readings, block by block.

The lag T is corrected by adding the motion of the axis during T: ``x = y + T v``. The speed v is
the low-pass filtered derivative of the latest readings; the filter limits the noise. The other
errors are removed by a few iterations of ``q = (x − o − bend(q) − Σ w E(q))/(1 + e)``, which invert
the model.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.sensor import SensorModel
from rotemina.sim.calibration.sensor_lag import SensorLag
from rotemina.sim.compensate import compute_stops

# Each iteration leaves at most a few per cent of the error.
_ITERATION_COUNT = 4
# Time constant of the speed filter, unless the lag is longer.
_MIN_SMOOTHING_S = 5e-3
# After an interval longer than this many usual intervals, the previous reading no longer
# shows the speed.
_PAUSE_TO_INTERVAL_RATIO = 5.0


class ReadingCorrection:
    """Correction of the readings of one axis, with a state from the earlier readings.

    Parameters
    ----------
    model : SensorModel
    travel : (low, high)
        Range in which the model was fitted, m or rad. Beyond it, the errors at its ends are used.
    """

    def __init__(self, model: SensorModel, travel: tuple[float, float]) -> None:
        # The import takes half a second. Programs without corrections do not need it, and it must
        # not happen while readings arrive.
        from scipy.signal import lfilter

        self._filter = lfilter
        self._model = model
        self._travel = travel
        self._radii = np.array(model.radii)
        self._weights = np.array(model.weights)
        self.restart()

    def restart(self) -> None:
        """Forget all earlier readings."""
        self._plays: FloatArray | None = None
        # Time and reading of the latest row.
        self._latest_row: tuple[float, float] | None = None
        self._speed = 0.0
        self._interval_s = 0.0

    def apply(self, time_s: FloatArray, reading: FloatArray) -> FloatArray:
        """Return the positions (n,) of the axis, m or rad, for readings (n,).

        The readings must be later than all earlier ones.
        """
        if not len(reading):
            return reading
        model = self._model
        linear = reading - model.offset
        if model.lag is not SensorLag.NONE:
            linear = linear + model.lag_s * self._compute_speeds(time_s, reading)
        position = linear / (1.0 + model.gain_error)
        hysteresis = self._compute_hysteresis(position)
        for _ in range(_ITERATION_COUNT):
            clipped = np.clip(position, *self._travel)
            position = (linear - model.compute_position_error(clipped) - hysteresis) / (
                1.0 + model.gain_error
            )
        return np.asarray(position)

    def _compute_hysteresis(self, position: FloatArray) -> FloatArray | float:
        if not len(self._radii):
            return 0.0
        if self._plays is None:
            self._plays = np.full(len(self._radii), position[0])
        return np.asarray(compute_stops(position, self._radii, self._plays) @ self._weights)

    def _compute_speeds(self, time_s: FloatArray, reading: FloatArray) -> FloatArray:
        """Return smoothed speeds (n,); nearly even intervals are assumed."""
        previous_row = self._latest_row if self._latest_row is not None else (time_s[0], reading[0])
        self._latest_row = float(time_s[-1]), float(reading[-1])
        elapsed_s = np.diff(time_s, prepend=previous_row[0])
        steps = np.diff(reading, prepend=previous_row[1])
        positive_s = elapsed_s[elapsed_s > 0.0]
        if not len(positive_s):
            return np.full(len(reading), self._speed)
        interval_s = float(np.median(positive_s))
        after_pause = elapsed_s > _PAUSE_TO_INTERVAL_RATIO * (self._interval_s or interval_s)
        self._interval_s = interval_s
        raw_speeds = np.where(
            (elapsed_s > 0.0) & ~after_pause, steps / np.where(elapsed_s > 0.0, elapsed_s, 1.0), 0.0
        )
        decay = float(np.exp(-interval_s / max(_MIN_SMOOTHING_S, self._model.lag_s)))
        speeds, _ = self._filter([1.0 - decay], [1.0, -decay], raw_speeds, zi=[decay * self._speed])
        self._speed = float(speeds[-1])
        return np.asarray(speeds)
