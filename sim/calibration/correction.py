"""Causal correction of a sensor's reading, portion by portion.

The lag is made good by what the axis moves on meanwhile, ``x = y + T v``, with its speed v from
the latest readings (a low pass, so that noise is not made larger); the rest is the model turned
round, ``q = (x − o − bend(q) − Σ w E(q))/(1 + e)``, by a few rounds.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.sensor import SensorModel
from rotemina.sim.calibration.sensor_lag import Lag
from rotemina.sim.stops import stops

_ROUNDS = 4  # each leaves a few per cent of the error at the most
_SMOOTHED_S = 5e-3  # over which the speed is taken, or the lag where that is longer
_PAUSE = 5.0  # times the usual interval: what came before says nothing of the speed


class Correction:
    """The correction of one axis; it remembers the latest readings.

    Parameters
    ----------
    model : SensorModel
        Of the sensor.
    travel : (low, high)
        Where the model was fitted, m or rad; beyond, the errors of its ends hold.
    """

    def __init__(self, model: SensorModel, travel: tuple[float, float]) -> None:
        # Half a second, which a program without corrections is spared; and not amid the readings.
        from scipy.signal import lfilter

        self._filter = lfilter
        self._model = model
        self._travel = travel
        self._radii = np.array(model.radii)
        self._weights = np.array(model.weights)
        self.restart()

    def restart(self) -> None:
        """Forget what was read before."""
        self._plays: FloatArray | None = None
        self._last: tuple[float, float] | None = None  # time and reading
        self._speed = 0.0
        self._interval_s = 0.0

    def apply(self, time_s: FloatArray, reading: FloatArray) -> FloatArray:
        """Return where the axis is (n,), m or rad, by readings (n,) later than all before."""
        if not len(reading):
            return reading
        model = self._model
        line = reading - model.offset
        if model.lag is not Lag.NONE:
            line = line + model.lag_s * self._speeds(time_s, reading)
        position = line / (1.0 + model.gain_error)
        loop = self._loop(position)
        for _ in range(_ROUNDS):
            within = np.clip(position, *self._travel)
            position = (line - model.bent(within) - loop) / (1.0 + model.gain_error)
        return np.asarray(position)

    def _loop(self, position: FloatArray) -> FloatArray | float:
        if not len(self._radii):
            return 0.0
        if self._plays is None:
            self._plays = np.full(len(self._radii), position[0])
        return np.asarray(stops(position, self._radii, self._plays) @ self._weights)

    def _speeds(self, time_s: FloatArray, reading: FloatArray) -> FloatArray:
        """Return smoothed speeds (n,), with intervals that are nearly even."""
        before = self._last if self._last is not None else (time_s[0], reading[0])
        self._last = float(time_s[-1]), float(reading[-1])
        elapsed = np.diff(time_s, prepend=before[0])
        steps = np.diff(reading, prepend=before[1])
        known = elapsed[elapsed > 0.0]
        if not len(known):
            return np.full(len(reading), self._speed)
        interval_s = float(np.median(known))
        paused = elapsed > _PAUSE * (self._interval_s or interval_s)
        self._interval_s = interval_s
        raw = np.where(
            (elapsed > 0.0) & ~paused, steps / np.where(elapsed > 0.0, elapsed, 1.0), 0.0
        )
        kept = float(np.exp(-interval_s / max(_SMOOTHED_S, self._model.lag_s)))
        speeds, _ = self._filter([1.0 - kept], [1.0, -kept], raw, zi=[kept * self._speed])
        self._speed = float(speeds[-1])
        return np.asarray(speeds)
