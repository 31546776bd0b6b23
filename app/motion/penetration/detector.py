"""Contact detection: a sequential test on the difference between sensor and model.

The residual ``r = meas − model`` of a moving axis contains noise. Hysteresis, creep and a wrong
gain give it a slope over the path s that changes slowly. A contact causes a kink. A Kalman filter
of level and slope follows the residual,

    level' = level + slope ds + c,   slope' = slope + w,   r = level + v,
    w ~ N(0, q ds),   c ~ N(0, σ² dt/1 s),   v ~ N(0, σ²),   slope₀ ~ N(0, drift²)

Without contact its innovations z, each divided by its own standard deviation, are white and
N(0, 1), even if the slope drifts. They are summed one-sidedly (Page's CUSUM),

    g = max(0, g + z − k),   alarm at g > h,   k = ½

The threshold h is chosen for the requested mean number of samples between false alarms, by
Siegmund's approximation ``(e^(2k b) − 2k b − 1) / 2k²`` with ``b = h + 1.166``. The kink is where g
last left zero.

Sources: Page, Biometrika 41 (1954) 100–115; Siegmund, Sequential Analysis (1985), section 2.6;
Basseville and Nikiforov, Detection of Abrupt Changes (1993), sections 2.2 and 7.2.
"""

from dataclasses import dataclass
from math import exp, pi, sqrt
from typing import NamedTuple

import numpy as np
import scipy

from rotemina.app.errors import PenetrationError
from rotemina.sim.arrays import FloatArray

# k of the CUSUM: half of the shift that it detects soonest, in standard deviations.
CUSUM_REFERENCE = 0.5
# Siegmund's correction for the overshoot of g over h.
_SIEGMUND_CORRECTION = 1.166
# Random walk of the level in one second, in standard deviations of the noise.
_LEVEL_CREEP_SIGMA = 1.0
# Innovations are clipped to this many standard deviations, so that one outlier causes no alarm.
_MAX_INNOVATION_SIGMA = 4.0
# The tip was already in contact at the start if the residual grows by more than this many times the
# drift plus this many standard deviations of the noise.
_START_CONTACT_SLOPE_RATIO = 3.0
_START_CONTACT_MARGIN_SIGMA = 6.0
_MIN_REST_SAMPLES = 40
# During this many samples at the start of the motion the level may jump, by the distance that the
# axis moves in ``_START_LAG_SAMPLES`` samples.
_START_SAMPLE_COUNT = 3
_START_LAG_SAMPLES = 2.0
# A simulated sensor may have no noise at all.
_MIN_RMS_M = 1e-11


class _CommandSample(NamedTuple):
    time_s: float
    command: float
    measured: float


@dataclass(frozen=True, slots=True)
class ResidualNoise:
    """Noise of a residual at rest: mean ``level`` and standard deviation, m, and sample rate."""

    level: float
    rms: float
    rate_hz: float


@dataclass(frozen=True, slots=True)
class DetectedContact:
    """A detected contact.

    Attributes
    ----------
    command, measured : float
        Command and reading of the axis when the contact began, m.
    time_s, detected_s : float
        Device time of the contact, and of its detection.
    from_start : bool
        Whether the tip was in contact from the start of the approach.
    """

    command: float
    measured: float
    time_s: float
    detected_s: float
    was_at_start: bool

    @property
    def delay_s(self) -> float:
        """Time that the detection took, on the device's clock."""
        return self.detected_s - self.time_s


def measure_noise_at_rest(
    time_s: FloatArray, residual: FloatArray, floor: float = 0.0
) -> ResidualNoise:
    """Return the noise of a residual (n,) at rest, apart from slow drift.

    The standard deviation is ``√π/2`` times the mean absolute first difference. Rounding to the
    sensor's resolution does not change this mean, but would round a median.

    Parameters
    ----------
    time_s, residual : (n,)
    floor : float
        Smallest possible standard deviation of the sensor, m. Rounding may hide smaller noise.

    Raises
    ------
    PenetrationError
        If there are too few samples.
    """
    if len(residual) < _MIN_REST_SAMPLES:
        raise PenetrationError(
            "contact: {count} samples at rest, but at least {least_samples} are needed "
            "to measure the noise; wait",
            count=len(residual),
            least_samples=_MIN_REST_SAMPLES,
        )
    steps = np.diff(residual)
    rms = 0.5 * sqrt(pi) * float(np.mean(np.abs(steps)))
    rate_hz = (len(time_s) - 1) / float(time_s[-1] - time_s[0])
    level = float(np.mean(residual[-_MIN_REST_SAMPLES:]))
    return ResidualNoise(level, max(rms, floor, _MIN_RMS_M), rate_hz)


def compute_samples_between_alarms(threshold: float) -> float:
    """Return the mean number of samples until g exceeds a threshold for pure N(0, 1) input."""
    b = 2.0 * CUSUM_REFERENCE * (threshold + _SIEGMUND_CORRECTION)
    return (exp(b) - b - 1.0) / (2.0 * CUSUM_REFERENCE**2)


def find_threshold(samples: float) -> float:
    """Return the threshold h for a mean number of samples between false alarms."""
    if samples <= compute_samples_between_alarms(0.0):
        return 0.0
    return float(
        scipy.optimize.brentq(lambda h: compute_samples_between_alarms(h) - samples, 0.0, 500.0)
    )


class ContactDetector:
    """Sequential contact test that runs from the start of an approach.

    Parameters
    ----------
    noise : ResidualNoise
        Noise of the residual at rest.
    command : float
        Command at the start of the approach, m.
    sign : float
        Direction of the approach. A contact pushes against it.
    drift : float
        Standard deviation of the slope of the residual over the command, as caused by hysteresis,
        creep and a wrong gain.
    drift_length : float
        Distance, m, over which this slope may change by ``drift``.
    false_alarms_per_hour : float
    """

    def __init__(
        self,
        noise: ResidualNoise,
        command: float,
        sign: float,
        *,
        drift: float,
        drift_length: float,
        false_alarms_per_hour: float,
    ) -> None:
        self.threshold = find_threshold(3600.0 * noise.rate_hz / false_alarms_per_hour)
        self._noise = noise
        self._start_command = command
        self._contact_sign = -1.0 if sign > 0.0 else 1.0
        self._drift = drift
        # This is q.
        self._slope_variance_per_m = drift**2 / drift_length
        self._level = self._rest_level = noise.level
        self._slope = 0.0
        # Variance of the level, covariance of level and slope, variance of the slope.
        self._covariance = (noise.rms**2 / _MIN_REST_SAMPLES, 0.0, drift**2)
        self._cusum = 0.0
        self._start_samples_left = _START_SAMPLE_COUNT
        # Time and command.
        self._previous_sample: tuple[float, float] | None = None
        # Sample at which the sum last left zero.
        self._kink: _CommandSample | None = None

    def feed(
        self, time_s: FloatArray, command: FloatArray, measured: FloatArray, residual: FloatArray
    ) -> DetectedContact | None:
        """Process consecutive samples (n,); return the contact as soon as it is certain."""
        rows = np.stack([time_s, command, measured, residual], axis=1).tolist()
        for sample_s, commanded, reading, difference in rows:
            score = self._update_filter(sample_s, commanded, difference)
            self._cusum = max(0.0, self._cusum + self._contact_sign * score - CUSUM_REFERENCE)
            if self._cusum == 0.0 or self._kink is None:
                self._kink = _CommandSample(sample_s, commanded, reading)
            if self._cusum > self.threshold:
                kink = self._kink
                return DetectedContact(kink.command, kink.measured, kink.time_s, sample_s, False)
            if self._is_start_contact(commanded):
                return DetectedContact(self._start_command, reading, sample_s, sample_s, True)
        return None

    def _is_start_contact(self, command: float) -> bool:
        """Return whether the level has risen faster than any drift since the start."""
        travel = abs(command - self._start_command)
        if travel == 0.0:
            # Creep continues while the axis still rests.
            self._rest_level = self._level
        limit = (
            _START_CONTACT_SLOPE_RATIO * self._drift * travel
            + _START_CONTACT_MARGIN_SIGMA * self._noise.rms
        )
        return self._contact_sign * (self._level - self._rest_level) > limit

    def _update_filter(self, time_s: float, command: float, residual: float) -> float:
        """Update level and slope; return the innovation in standard deviations."""
        previous_s, previous_command = (
            self._previous_sample if self._previous_sample is not None else (time_s, command)
        )
        self._previous_sample = (time_s, command)
        ds = abs(command - previous_command)
        noise_variance = self._noise.rms**2
        # p, c and s are the variance of the level, the covariance, and the variance of the slope.
        p, c, s = self._covariance
        if ds > 0.0 and self._start_samples_left:
            # A model that holds each command until the next lags behind a device that does not.
            self._start_samples_left -= 1
            p += (_START_LAG_SAMPLES * ds) ** 2
        q = self._slope_variance_per_m * ds
        p += ds * (2.0 * c + ds * (s + q / 3.0)) + _LEVEL_CREEP_SIGMA**2 * noise_variance * (
            time_s - previous_s
        )
        c += ds * (s + 0.5 * q)
        s += q
        variance = p + noise_variance
        self._level += ds * self._slope
        deviation = sqrt(variance)
        score = min(
            max((residual - self._level) / deviation, -_MAX_INNOVATION_SIGMA), _MAX_INNOVATION_SIGMA
        )
        innovation = score * deviation
        self._level += p / variance * innovation
        self._slope += c / variance * innovation
        self._covariance = (
            p * noise_variance / variance,
            c * noise_variance / variance,
            s - c * c / variance,
        )
        return score
