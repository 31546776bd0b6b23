"""The contact's test: its false alarms, its delay, and what it must not take for a contact."""

import numpy as np
import pytest

from rotemina.app.motion.penetration.detector import (
    ContactDetector,
    noise_at_rest,
    samples_between_alarms,
    threshold_for,
)
from rotemina.app.motion.penetration.parameters import PenetrationError

RATE_HZ, SIGMA, SPEED = 1000.0, 12e-9, -10e-6


def rest(rng, count=500):
    return noise_at_rest(np.arange(count) / RATE_HZ, rng.normal(0.0, SIGMA, count))


def approach(rng, seconds, disturbed=lambda way: 0.0 * way):
    """Return what a detector is fed: on the way down, with a disturbance over the way."""
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    way = -SPEED * time_s
    residual = rng.normal(0.0, SIGMA, len(time_s)) + disturbed(way)
    return time_s, -way, -way + residual, residual


def detector(rng, *, drift=0.15, alarms=1.0):
    return ContactDetector(
        rest(rng), 0.0, SPEED, drift=drift, drift_length=1e-3, false_alarms_per_hour=alarms
    )


def kink(place, slope):
    return lambda way: slope * np.maximum(way - place, 0.0)


def test_the_noise_is_known_in_spite_of_rounding_and_a_drift():
    rng = np.random.default_rng(1)
    time_s = np.arange(1000) / RATE_HZ
    rounded = np.round(rng.normal(0.0, SIGMA, 1000) / 7.9e-9) * 7.9e-9 + 2e-7 * time_s
    noise = noise_at_rest(time_s, rounded)
    assert noise.rms == pytest.approx(np.hypot(SIGMA, 7.9e-9 / np.sqrt(12)), rel=0.08)
    assert noise.rate_hz == pytest.approx(RATE_HZ)
    with pytest.raises(PenetrationError, match="39 samples at rest"):
        noise_at_rest(time_s[:39], rounded[:39])
    assert noise_at_rest(time_s, 0.0 * time_s, 2e-9).rms == 2e-9


def test_the_threshold_gives_the_false_alarms_that_were_asked_for():
    wanted = 400.0
    threshold = threshold_for(wanted)
    assert samples_between_alarms(threshold) == pytest.approx(wanted)
    rng = np.random.default_rng(2)
    lengths = []
    for _ in range(400):
        total, count = 0.0, 0
        while total <= threshold:
            total = max(0.0, total + rng.normal() - 0.5)
            count += 1
        lengths.append(count)
    assert np.mean(lengths) == pytest.approx(wanted, rel=0.15)


def test_innovations_of_noise_alone_raise_alarms_as_rarely_as_that():
    rng = np.random.default_rng(3)
    # One alarm in 2 s on average: 200 runs of 1 s raise one in about 1 − e^(−½) of them.
    alarms = sum(
        detector(rng, alarms=1800.0).feed(*approach(rng, 1.0)) is not None for _ in range(200)
    )
    assert 30 < alarms < 110


def test_a_soft_membrane_is_placed_within_a_fifth_of_a_micrometre_at_the_rate_of_telemetry():
    rng = np.random.default_rng(12)
    errors = []
    for _ in range(300):
        feed = (column[::5] for column in approach(rng, 1.0, kink(6e-6, 0.1)))
        noise = noise_at_rest(np.arange(200) / 200.0, rng.normal(0.0, SIGMA, 200))
        found = ContactDetector(
            noise, 0.0, SPEED, drift=0.15, drift_length=1e-3, false_alarms_per_hour=1.0
        ).feed(*feed)
        assert found is not None
        errors.append(found.command + 6e-6)
    assert np.std(errors) < 2e-7
    assert np.mean(np.abs(errors) > 5e-7) < 0.02


@pytest.mark.parametrize("slope", [0.1, 0.25, 0.5])
def test_a_kink_is_found_soon_and_where_it_was(slope):
    rng = np.random.default_rng(4)
    for _ in range(20):
        found = detector(rng).feed(*approach(rng, 1.0, kink(6e-6, slope)))
        assert found is not None
        assert 0.6 - 0.03 < found.time_s < found.detected_s < 0.6 + 0.015 / slope
        assert not found.from_start
        assert found.command == pytest.approx(-6e-6, abs=5e-7)


def test_slopes_that_change_slowly_are_no_contact():
    rng = np.random.default_rng(5)
    for _ in range(20):
        slopes = rng.normal(0.0, 0.15, 2)
        bent = lambda way, s=slopes: s[0] * way + 0.2 * s[1] * way**2 / 2e-5  # noqa: E731
        assert detector(rng).feed(*approach(rng, 1.0, bent)) is None


def test_creep_at_rest_before_the_motion_is_no_contact():
    rng = np.random.default_rng(6)
    time_s = np.arange(1000) / RATE_HZ
    residual = rng.normal(0.0, SIGMA, 1000) + 1.5e-7 * time_s
    assert detector(rng).feed(time_s, 0.0 * time_s, residual, residual) is None


def test_a_model_that_lags_a_sample_behind_is_no_contact():
    # Telemetry of 200 Hz: the device moves on by 50 nm while the model holds the latest command.
    for seed in range(40):
        rng = np.random.default_rng(seed)
        time_s = np.arange(300) / 200.0
        way = np.maximum(time_s - 0.302, 0.0) * 10e-6
        lead = np.diff(way, prepend=0.0)
        residual = rng.normal(0.0, SIGMA, 300) - lead
        assert detector(rng).feed(time_s, -way, -way, residual) is None


def test_a_pull_is_no_contact_and_an_outlier_is_none():
    rng = np.random.default_rng(7)
    assert detector(rng).feed(*approach(rng, 1.0, kink(5e-6, -0.1))) is None
    time_s, command, measured, residual = approach(rng, 1.0)
    residual[[300, 600, 900]] += 50 * SIGMA
    assert detector(rng).feed(time_s, command, measured, residual) is None


def test_a_wall_at_the_very_start_is_leant_on():
    rng = np.random.default_rng(8)
    found = detector(rng).feed(*approach(rng, 1.0, kink(0.0, 0.8)))
    assert found is not None
    assert found.detected_s < 0.05
