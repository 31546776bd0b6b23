from math import nan, pi, sin

import pytest

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration
from rotemina.app.motion.teleoperation.input_trust import AxisTrust

STICK = AxisCalibration()


def fed(readings, calibration=STICK):
    trust = AxisTrust(calibration)
    for time_s, raw in readings:
        trust.feed(time_s, raw)
    return trust


def at_100_hz(raws, begin_s=0.0):
    return [(begin_s + 0.01 * count, raw) for count, raw in enumerate(raws)]


def test_a_tenth_of_a_second_at_rest_earns_trust():
    trust = fed(at_100_hz([0.05] * 10))
    assert "release it" in trust.reason
    trust.feed(0.1, 0.05)
    assert trust.reason is None


def test_passing_through_the_centre_does_not():
    raws = [0.4 * sin(2 * pi * count / 20) for count in range(200)]
    assert fed(at_100_hz(raws)).reason is not None


def test_a_device_that_speaks_only_of_changes_may_earn_it_in_silence():
    trust = fed([(0.0, 0.0)])
    trust.step(0.05)
    assert trust.reason is not None
    trust.step(0.1)
    assert trust.reason is None


@pytest.mark.parametrize("raw", [None, nan])
def test_what_has_said_nothing_is_not_at_rest(raw):
    trust = fed([] if raw is None else [(0.0, raw)])
    trust.step(10.0)
    assert "has not reported" in trust.reason
    assert not trust.plausible


def test_an_end_from_the_first_moment_is_named():
    trust = fed(at_100_hz([1.0] * 100))
    assert "at its end from the start" in trust.reason
    trust.feed(1.0, 0.6)
    assert "release it" in trust.reason


def test_holding_at_the_end_is_no_fault_of_a_trusted_stick():
    trust = fed(at_100_hz([0.0] * 11 + [1.0] * 500))
    assert trust.reason is None


def test_a_trigger_at_rest_is_at_no_end():
    trigger = AxisCalibration(low=-1.0, centre=-1.0, high=1.0)
    assert fed(at_100_hz([-1.0] * 11), trigger).reason is None
    assert "from the start" in fed(at_100_hz([-1.0] * 11)).reason


def test_a_bad_potentiometer_loses_trust_and_earns_it_anew():
    trust = fed(at_100_hz([0.0] * 11))
    for time_s, raw in at_100_hz([0.0, 0.5] * 8, begin_s=1.0):
        trust.feed(time_s, raw)
    assert "jitters" in trust.reason
    assert not trust.plausible
    trust.feed(1.2, 0.0)
    trust.step(1.9)
    assert "jitters" in trust.reason
    trust.step(2.3)
    assert trust.reason is None


def test_jitter_is_measured_against_the_range_of_the_stick():
    small = AxisCalibration(low=-0.2, centre=0.0, high=0.2, dead_zone=0.02)
    raws = [0.0, 0.06] * 10
    assert fed(at_100_hz(raws), small).plausible is False
    assert fed(at_100_hz(raws)).plausible is True


@pytest.mark.parametrize("hertz", [1, 3, 5])
def test_a_hand_that_shakes_the_stick_is_no_jitter(hertz):
    raws = [sin(2 * pi * hertz * count / 100) for count in range(500)]
    assert fed(at_100_hz(raws)).plausible


def test_keys_may_be_tapped_fast():
    taps = [(0.06 * count, float(count % 2)) for count in range(100)]
    assert fed(taps).plausible


@pytest.mark.parametrize("raw", [1.5, -2.0, float("inf")])
def test_impossible_numbers_lose_trust(raw):
    trust = fed([*at_100_hz([0.0] * 11), (0.2, raw)])
    assert "outside −1 to 1" in trust.reason
    trust.feed(0.3, 0.0)
    assert "release it" in trust.reason


def test_after_a_reset_a_stick_that_is_at_rest_is_trusted_and_one_that_is_not_is_not():
    trust = fed(at_100_hz([0.0] * 11))
    trust.reset("taken over")
    assert trust.reason == "taken over"
    trust.step(0.2)
    assert trust.reason is None
    trust.feed(0.3, 0.5)
    trust.reset("taken over")
    trust.step(9.0)
    assert trust.reason == "taken over"


def test_what_is_forgotten_must_be_said_anew():
    trust = fed(at_100_hz([0.0] * 11))
    trust.forget("silent")
    trust.step(9.0)
    assert trust.reason == "silent"
