"""Contact detection: a sequential test on the difference between sensor and model.

The residual ``r = meas − model`` of a moving axis contains noise, and the effects of hysteresis,
creep and a wrong gain: a slope over the path s that changes slowly. A contact is a kink. A Kalman
filter of level and slope follows the residual,

    level' = level + slope ds + c,   slope' = slope + w,   r = level + v,
    w ~ N(0, q ds),   c ~ N(0, σ² dt/1 s),   v ~ N(0, σ²),   slope₀ ~ N(0, drift²)

Its innovations z, each divided by its own standard deviation, are white and N(0, 1) without
contact, however the slope drifts. They are summed one-sidedly (Page's CUSUM),

    g = max(0, g + z − k),   alarm at g > h,   k = ½

and h gives the requested mean number of samples between false alarms by Siegmund's approximation
``(e^(2k b) − 2k b − 1) / 2k²`` with ``b = h + 1.166``. The kink is where g last left zero.

Sources: Page, Biometrika 41 (1954) 100–115; Siegmund, Sequential Analysis (1985), section 2.6;
Basseville and Nikiforov, Detection of Abrupt Changes (1993), sections 2.2 and 7.2.
"""

from dataclasses import dataclass
from math import exp, pi, sqrt

import numpy as np
import scipy

from rotemina.app.motion.penetration.parameters import PenetrationError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message

REFERENCE = 0.5  # k: half of the shift, in standard deviations, that is found soonest
_CORRECTION = 1.166  # of Siegmund's, for the overshoot over h
_CREEP = 1.0  # standard deviations of noise by which the level wanders in a second
_CLIP = 4.0  # standard deviations: one outlier alone is no contact
_STIFF = 3.0  # times the drift: a residual that grows faster is a wall, from the start on
_SURE = 6.0  # standard deviations beside that
_LEAST_SAMPLES = 40
_SETTING_OFF = 3  # samples in motion in which the level may jump
_LAG = 2.0  # samples, by which it may
_LEAST_RMS = 1e-11  # m; a simulated sensor may have no noise at all


@dataclass(frozen=True, slots=True)
class Noise:
    """A residual at rest: its mean, m, standard deviation, m, and samples per second."""

    level: float
    rms: float
    rate_hz: float


@dataclass(frozen=True, slots=True)
class Contact:
    """A detected contact.

    Attributes
    ----------
    command, measured : float
        Where the axis was when it met something, m.
    time_s, detected_s : float
        Device time of that, and of the alarm.
    from_start : bool
        Whether the tip leant on it from the very beginning.
    """

    command: float
    measured: float
    time_s: float
    detected_s: float
    from_start: bool

    @property
    def delay_s(self) -> float:
        """How long the test took, on the device's clock."""
        return self.detected_s - self.time_s


def noise_at_rest(time_s: FloatArray, residual: FloatArray, floor: float = 0.0) -> Noise:
    """Return the noise of a residual (n,) at rest; a slow drift does not count.

    The standard deviation is ``√π/2`` of the mean amount of first differences, which rounding to
    the sensor's resolution leaves as it is (a median would be rounded with them).

    Parameters
    ----------
    time_s, residual : (n,)
    floor : float
        What the sensor declares at least, m: rounding may hide a small noise.

    Raises
    ------
    PenetrationError
        If there are too few samples.
    """
    if len(residual) < _LEAST_SAMPLES:
        raise PenetrationError(
            message(
                "engine",
                "contact: {count} samples at rest, but at least {least_samples} are needed "
                "to measure the noise; wait",
            ).fill(count=len(residual), least_samples=_LEAST_SAMPLES)
        )
    steps = np.diff(residual)
    rms = 0.5 * sqrt(pi) * float(np.mean(np.abs(steps)))
    rate_hz = (len(time_s) - 1) / float(time_s[-1] - time_s[0])
    level = float(np.mean(residual[-_LEAST_SAMPLES:]))
    return Noise(level, max(rms, floor, _LEAST_RMS), rate_hz)


def samples_between_alarms(threshold: float) -> float:
    """Return the mean number of samples until g, for pure N(0, 1) input, exceeds a threshold."""
    b = 2.0 * REFERENCE * (threshold + _CORRECTION)
    return (exp(b) - b - 1.0) / (2.0 * REFERENCE**2)


def threshold_for(samples: float) -> float:
    """Return the threshold h with so many samples between false alarms, on average."""
    if samples <= samples_between_alarms(0.0):
        return 0.0
    return float(scipy.optimize.brentq(lambda h: samples_between_alarms(h) - samples, 0.0, 500.0))


class ContactDetector:
    """The test, sample by sample, from the start of an approach.

    Parameters
    ----------
    noise : Noise
        Of the residual at rest.
    command : float
        Where the approach begins, m.
    sign : float
        Of the approach: what is met pushes against it.
    drift : float
        Standard deviation of the residual's slope over the command's that hysteresis, creep and a
        wrong gain may cause.
    drift_length : float
        Way, m, over which that slope may change by as much.
    false_alarms_per_hour : float
    """

    def __init__(
        self,
        noise: Noise,
        command: float,
        sign: float,
        *,
        drift: float,
        drift_length: float,
        false_alarms_per_hour: float,
    ) -> None:
        self.threshold = threshold_for(3600.0 * noise.rate_hz / false_alarms_per_hour)
        self._noise = noise
        self._begin = command
        self._side = -1.0 if sign > 0.0 else 1.0
        self._drift = drift
        self._wander = drift**2 / drift_length  # q, 1/m
        self._level = self._rested = noise.level
        self._slope = 0.0
        self._p = (noise.rms**2 / _LEAST_SAMPLES, 0.0, drift**2)  # of level, both, slope
        self._sum = 0.0
        self._setting_off = _SETTING_OFF
        self._latest: tuple[float, float] | None = None  # time and command
        self._met: tuple[float, float, float] | None = None

    def feed(
        self, time_s: FloatArray, command: FloatArray, measured: FloatArray, residual: FloatArray
    ) -> Contact | None:
        """Take consecutive samples (n,); return the contact, once it is sure."""
        rows = np.stack([time_s, command, measured, residual], axis=1).tolist()
        for at_s, commanded, reading, value in rows:
            score = self._innovation(at_s, commanded, value)
            self._sum = max(0.0, self._sum + self._side * score - REFERENCE)
            if self._sum == 0.0 or self._met is None:
                self._met = (at_s, commanded, reading)
            if self._sum > self.threshold:
                return Contact(self._met[1], self._met[2], self._met[0], at_s, False)
            if self._leans(commanded):
                return Contact(self._begin, reading, at_s, at_s, True)
        return None

    def _leans(self, command: float) -> bool:
        """Return whether the level has risen as no drift makes it rise."""
        way = abs(command - self._begin)
        if way == 0.0:
            self._rested = self._level  # creep goes on while it still rests
        most = _STIFF * self._drift * way + _SURE * self._noise.rms
        return self._side * (self._level - self._rested) > most

    def _innovation(self, time_s: float, command: float, residual: float) -> float:
        """Follow the residual; return the innovation in standard deviations."""
        before_s, before = self._latest if self._latest is not None else (time_s, command)
        self._latest = (time_s, command)
        way = abs(command - before)
        noise = self._noise.rms**2
        p, c, s = self._p
        if way > 0.0 and self._setting_off:
            # A model that holds each command until the next lags behind a device that does not.
            self._setting_off -= 1
            p += (_LAG * way) ** 2
        q = self._wander * way
        p += way * (2.0 * c + way * (s + q / 3.0)) + _CREEP**2 * noise * (time_s - before_s)
        c += way * (s + 0.5 * q)
        s += q
        variance = p + noise
        self._level += way * self._slope
        deviation = sqrt(variance)
        score = min(max((residual - self._level) / deviation, -_CLIP), _CLIP)
        step = score * deviation
        self._level += p / variance * step
        self._slope += c / variance * step
        self._p = (p * noise / variance, c * noise / variance, s - c * c / variance)
        return score
