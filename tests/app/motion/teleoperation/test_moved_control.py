from math import nan, pi, sin

import numpy as np
import pytest

from rotemina.app.motion.teleoperation.moved_control import Detected, Detection, Kind
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.drivers.inputs.device import InputIdentity, InputReading

STICK = PluggedDevice(InputIdentity("a", "Stick", "hid"), ("X", "Y"), ("1", "2"))
PEDAL = PluggedDevice(InputIdentity("b", "Pedal", "hid"), ("Brake",), ())
STROKE = np.concatenate([np.zeros(20), np.linspace(0, 1, 15), np.linspace(1, 0, 15)])
STILL = np.zeros(50)


def found(x=STILL, y=STILL, one=(), two=(), wanted=None, now_s=None):
    """Return what is found in half a second of readings at 100 Hz."""
    detection = Detection([STICK, PEDAL], wanted)
    for count, axes in enumerate(zip(x, y, strict=True)):
        buttons = count in one, count in two
        detection.feed("a", InputReading(0.01 * count, tuple(map(float, axes)), buttons))
    return detection.findings(0.01 * len(x) if now_s is None else now_s)


def noise(amplitude, seed=0, size=50):
    return np.random.default_rng(seed).uniform(-amplitude, amplitude, size)


@pytest.mark.parametrize(("sign", "direction"), [(1, 1), (-1, -1)])
def test_the_axis_that_was_moved_is_found_with_its_direction(sign, direction):
    assert found(x=sign * STROKE, y=0.2 * STROKE).detected == Detected(
        "a", "X", Kind.AXIS, direction
    )


def test_a_button_is_found():
    assert found(one=range(20, 30)).detected == Detected("a", "1", Kind.BUTTON, 1)


def test_a_button_that_is_down_all_the_time_is_not():
    assert found(one=range(50), two=range(20, 30)).detected.control == "2"


def test_noise_and_a_small_move_are_nothing():
    findings = found(x=noise(0.3), y=0.4 * STROKE)
    assert findings.detected is None
    assert "move the control now" in findings.message


def test_an_axis_that_jitters_from_end_to_end_is_passed_over():
    findings = found(x=noise(1.0), y=STROKE)
    assert findings.detected.control == "Y"


def test_an_axis_that_drifts_is_passed_over():
    drift = np.linspace(-1, 1, 500)
    still = np.zeros(450)
    assert found(x=drift, y=np.concatenate([still, STROKE])).detected.control == "Y"


def test_a_single_wrong_reading_is_nothing():
    glitch = STILL.copy()
    glitch[25] = 1.0
    assert found(x=glitch).detected is None


def test_two_that_move_together_are_both_named():
    findings = found(x=STROKE, y=0.8 * STROKE)
    assert findings.detected is None
    assert "X (Stick) and Y (Stick) moved together" in findings.message


def test_of_a_trigger_that_is_axis_and_button_the_wanted_one_is_found():
    both = {"x": STROKE, "one": range(25, 40)}
    assert "1 (Stick)" in found(**both).message
    assert found(**both, wanted=Kind.AXIS).detected.control == "X"
    assert found(**both, wanted=Kind.BUTTON).detected.control == "1"


def test_a_shaken_stick_is_found_too():
    shaken = [sin(2 * pi * 2 * count / 100) for count in range(50)]
    assert found(x=shaken).detected.control == "X"


def test_a_hat_of_a_silent_device_is_found_when_it_is_held_a_moment():
    detection = Detection([STICK, PEDAL])
    detection.feed("a", InputReading(0.0, (0.0, nan), (False, False)))
    detection.feed("b", InputReading(0.0, (-1.0,), ()))
    detection.feed("a", InputReading(5.0, (-1.0, nan), (False, False)))
    assert detection.findings(5.01).detected is None
    assert detection.findings(5.05).detected == Detected("a", "X", Kind.AXIS, -1)


def test_of_two_devices_the_moved_one_is_found_and_forgotten_after_a_while():
    detection = Detection([STICK, PEDAL])
    detection.feed("a", InputReading(0.0, (0.0, 0.0), (False, False)))
    for time_s, raw in ((0.0, -1.0), (1.0, 1.0), (1.1, -1.0)):
        detection.feed("b", InputReading(time_s, (raw,), ()))
    assert detection.findings(1.2).detected == Detected("b", "Brake", Kind.AXIS, 1)
    assert "axis Brake of Pedal" in detection.findings(1.2).message
    assert detection.findings(3.0).detected is None


def test_nothing_is_found_before_anything_was_said():
    assert Detection([STICK]).findings(0.0).detected is None
