"""Contact detector: false alarms, delay, and signals that are no contact."""

import numpy as np
import pytest

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration.detector import (
    ContactDetector,
    compute_samples_between_alarms,
    find_threshold,
    measure_noise_at_rest,
)

RATE_HZ, SIGMA, SPEED = 1000.0, 12e-9, -10e-6


def make_noise_at_rest(rng, count=500):
    return measure_noise_at_rest(np.arange(count) / RATE_HZ, rng.normal(0.0, SIGMA, count))


def make_approach(rng, seconds, disturbance=lambda travel: 0.0 * travel):
    """Return the input of a detector on the way down, with a disturbance over the travel."""
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    travel = -SPEED * time_s
    residual = rng.normal(0.0, SIGMA, len(time_s)) + disturbance(travel)
    return time_s, -travel, -travel + residual, residual


def make_detector(rng, *, drift=0.15, alarms=1.0):
    return ContactDetector(
        make_noise_at_rest(rng),
        0.0,
        SPEED,
        drift=drift,
        drift_length=1e-3,
        false_alarms_per_hour=alarms,
    )


def make_contact(position, slope):
    return lambda travel: slope * np.maximum(travel - position, 0.0)


def test_noise_is_measured_despite_rounding_and_drift():
    rng = np.random.default_rng(1)
    time_s = np.arange(1000) / RATE_HZ
    rounded = np.round(rng.normal(0.0, SIGMA, 1000) / 7.9e-9) * 7.9e-9 + 2e-7 * time_s
    noise = measure_noise_at_rest(time_s, rounded)
    assert noise.rms == pytest.approx(np.hypot(SIGMA, 7.9e-9 / np.sqrt(12)), rel=0.08)
    assert noise.rate_hz == pytest.approx(RATE_HZ)
    with pytest.raises(PenetrationError, match="39 samples at rest"):
        measure_noise_at_rest(time_s[:39], rounded[:39])
    assert measure_noise_at_rest(time_s, 0.0 * time_s, 2e-9).rms == 2e-9


def test_the_threshold_gives_the_requested_false_alarm_rate():
    target_length = 400.0
    threshold = find_threshold(target_length)
    assert compute_samples_between_alarms(threshold) == pytest.approx(target_length)
    rng = np.random.default_rng(2)
    lengths = []
    for _ in range(400):
        total, count = 0.0, 0
        while total <= threshold:
            total = max(0.0, total + rng.normal() - 0.5)
            count += 1
        lengths.append(count)
    assert np.mean(lengths) == pytest.approx(target_length, rel=0.15)


def test_noise_alone_raises_alarms_at_the_requested_rate():
    rng = np.random.default_rng(3)
    # At one alarm in 2 s on average, a share of 1 − e^(−½) of the 1 s runs raises one.
    alarms = sum(
        make_detector(rng, alarms=1800.0).feed(*make_approach(rng, 1.0)) is not None
        for _ in range(200)
    )
    assert 30 < alarms < 110


def test_a_soft_membrane_is_located_within_200_nm_at_the_telemetry_rate():
    rng = np.random.default_rng(12)
    errors = []
    for _ in range(300):
        samples = (column[::5] for column in make_approach(rng, 1.0, make_contact(6e-6, 0.1)))
        noise = measure_noise_at_rest(np.arange(200) / 200.0, rng.normal(0.0, SIGMA, 200))
        contact = ContactDetector(
            noise, 0.0, SPEED, drift=0.15, drift_length=1e-3, false_alarms_per_hour=1.0
        ).feed(*samples)
        assert contact is not None
        errors.append(contact.command + 6e-6)
    assert np.std(errors) < 2e-7
    assert np.mean(np.abs(errors) > 5e-7) < 0.02


@pytest.mark.parametrize("slope", [0.1, 0.5])
def test_a_kink_is_detected_soon_and_located(slope):
    rng = np.random.default_rng(4)
    for _ in range(10):
        contact = make_detector(rng).feed(*make_approach(rng, 1.0, make_contact(6e-6, slope)))
        assert contact is not None
        assert 0.6 - 0.03 < contact.time_s < contact.detected_s < 0.6 + 0.015 / slope
        assert not contact.was_at_start
        assert contact.command == pytest.approx(-6e-6, abs=5e-7)


def test_slopes_that_change_slowly_are_no_contact():
    rng = np.random.default_rng(5)
    for _ in range(20):
        slopes = rng.normal(0.0, 0.15, 2)
        curve = lambda travel, s=slopes: s[0] * travel + 0.2 * s[1] * travel**2 / 2e-5  # noqa: E731
        assert make_detector(rng).feed(*make_approach(rng, 1.0, curve)) is None


def test_a_model_that_lags_by_one_sample_is_no_contact():
    # At 200 Hz telemetry the device moves on by 50 nm while the model holds the latest command.
    for seed in range(10):
        rng = np.random.default_rng(seed)
        time_s = np.arange(300) / 200.0
        travel = np.maximum(time_s - 0.302, 0.0) * 10e-6
        lead = np.diff(travel, prepend=0.0)
        residual = rng.normal(0.0, SIGMA, 300) - lead
        assert make_detector(rng).feed(time_s, -travel, -travel, residual) is None


def test_neither_a_pull_nor_an_outlier_is_a_contact():
    rng = np.random.default_rng(7)
    assert make_detector(rng).feed(*make_approach(rng, 1.0, make_contact(5e-6, -0.1))) is None
    time_s, command, measured, residual = make_approach(rng, 1.0)
    residual[[300, 600, 900]] += 50 * SIGMA
    assert make_detector(rng).feed(time_s, command, measured, residual) is None
