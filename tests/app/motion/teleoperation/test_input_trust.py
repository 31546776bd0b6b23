from math import nan, pi, sin

import pytest

from rotemina.app.motion.inputs import InputAxisCalibration
from rotemina.app.motion.inputs.input_trust import AxisTrust

STICK = InputAxisCalibration()


def feed_trust(readings, calibration=STICK):
    trust = AxisTrust(calibration)
    for time_s, raw in readings:
        trust.feed(time_s, raw)
    return trust


def sample_at_100_hz(raws, begin_s=0.0):
    return [(begin_s + 0.01 * count, raw) for count, raw in enumerate(raws)]


def test_a_tenth_of_a_second_at_rest_earns_trust():
    trust = feed_trust(sample_at_100_hz([0.05] * 10))
    assert "release it" in trust.reason
    trust.feed(0.1, 0.05)
    assert trust.reason is None


def test_passing_through_the_centre_earns_no_trust():
    raws = [0.4 * sin(2 * pi * count / 20) for count in range(200)]
    assert feed_trust(sample_at_100_hz(raws)).reason is not None


def test_a_silent_device_at_rest_earns_trust():
    trust = feed_trust([(0.0, 0.0)])
    trust.step(0.05)
    assert trust.reason is not None
    trust.step(0.1)
    assert trust.reason is None


@pytest.mark.parametrize("raw", [None, nan])
def test_a_device_without_reports_is_not_at_rest(raw):
    trust = feed_trust([] if raw is None else [(0.0, raw)])
    trust.step(10.0)
    assert "has not reported" in trust.reason
    assert not trust.is_plausible


def test_a_stick_at_its_end_from_the_start_is_reported():
    trust = feed_trust(sample_at_100_hz([1.0] * 100))
    assert "at its end from the start" in trust.reason
    trust.feed(1.0, 0.6)
    assert "release it" in trust.reason


def test_a_trusted_stick_may_be_held_at_its_end():
    trust = feed_trust(sample_at_100_hz([0.0] * 11 + [1.0] * 500))
    assert trust.reason is None


def test_a_trigger_at_rest_is_not_at_an_end():
    trigger = InputAxisCalibration(low=-1.0, centre=-1.0, high=1.0)
    assert feed_trust(sample_at_100_hz([-1.0] * 11), trigger).reason is None
    assert "from the start" in feed_trust(sample_at_100_hz([-1.0] * 11)).reason


def test_a_jittering_potentiometer_loses_trust_and_can_earn_it_again():
    trust = feed_trust(sample_at_100_hz([0.0] * 11))
    for time_s, raw in sample_at_100_hz([0.0, 0.5] * 8, begin_s=1.0):
        trust.feed(time_s, raw)
    assert "jitters" in trust.reason
    assert not trust.is_plausible
    trust.feed(1.2, 0.0)
    trust.step(1.9)
    assert "jitters" in trust.reason
    trust.step(2.3)
    assert trust.reason is None


def test_jitter_is_measured_against_the_range_of_the_stick():
    small = InputAxisCalibration(low=-0.2, centre=0.0, high=0.2, dead_zone=0.02)
    raws = [0.0, 0.06] * 10
    assert feed_trust(sample_at_100_hz(raws), small).is_plausible is False
    assert feed_trust(sample_at_100_hz(raws)).is_plausible is True


@pytest.mark.parametrize("hertz", [1, 5])
def test_shaking_the_stick_by_hand_is_no_jitter(hertz):
    raws = [sin(2 * pi * hertz * count / 100) for count in range(500)]
    assert feed_trust(sample_at_100_hz(raws)).is_plausible


def test_fast_taps_of_keys_are_plausible():
    taps = [(0.06 * count, float(count % 2)) for count in range(100)]
    assert feed_trust(taps).is_plausible


@pytest.mark.parametrize("raw", [1.5, float("-inf")])
def test_impossible_numbers_lose_trust(raw):
    trust = feed_trust([*sample_at_100_hz([0.0] * 11), (0.2, raw)])
    assert "outside −1 to 1" in trust.reason
    trust.feed(0.3, 0.0)
    assert "release it" in trust.reason


def test_after_a_reset_only_a_stick_at_rest_is_trusted():
    trust = feed_trust(sample_at_100_hz([0.0] * 11))
    trust.distrust("taken over")
    assert trust.reason == "taken over"
    trust.step(0.2)
    assert trust.reason is None
    trust.feed(0.3, 0.5)
    trust.distrust("taken over")
    trust.step(9.0)
    assert trust.reason == "taken over"


def test_forgotten_reports_must_be_sent_again():
    trust = feed_trust(sample_at_100_hz([0.0] * 11))
    trust.forget_reports("silent")
    trust.step(9.0)
    assert trust.reason == "silent"
