from math import nan, pi, sin

import numpy as np
import pytest

from rotemina.app.motion.inputs import (
    ControlDetector,
    ControlKind,
    MovedControl,
    PluggedDevice,
)
from rotemina.drivers.inputs import InputIdentity, InputReading

STICK = PluggedDevice(InputIdentity("a", "Stick", "hid"), ("X", "Y"), ("1", "2"))
PEDAL = PluggedDevice(InputIdentity("b", "Pedal", "hid"), ("Brake",), ())
STROKE = np.concatenate([np.zeros(20), np.linspace(0, 1, 15), np.linspace(1, 0, 15)])
STILL = np.zeros(50)


def find_control(x=STILL, y=STILL, button_1=(), button_2=(), wanted_kind=None, now_s=None):
    """Return the control found in half a second of readings at 100 Hz."""
    detection = ControlDetector([STICK, PEDAL], wanted_kind)
    for count, axes in enumerate(zip(x, y, strict=True)):
        buttons = count in button_1, count in button_2
        detection.feed("a", InputReading(0.01 * count, tuple(map(float, axes)), buttons))
    return detection.find_moved_control(0.01 * len(x) if now_s is None else now_s)


def make_noise(amplitude, seed=0, size=50):
    return np.random.default_rng(seed).uniform(-amplitude, amplitude, size)


@pytest.mark.parametrize("sign", [1, -1])
def test_the_axis_that_was_moved_is_found_with_its_direction(sign):
    assert find_control(x=sign * STROKE, y=0.2 * STROKE).moved_control == MovedControl(
        "a", "X", ControlKind.AXIS, sign
    )


def test_a_pressed_button_is_found_and_one_that_is_down_all_the_time_is_not():
    assert find_control(button_1=range(50), button_2=range(20, 30)).moved_control == MovedControl(
        "a", "2", ControlKind.BUTTON, 1
    )


def test_noise_and_a_small_move_are_ignored():
    findings = find_control(x=make_noise(0.3), y=0.4 * STROKE)
    assert findings.moved_control is None
    assert "move the control now" in findings.message


def test_an_axis_that_jitters_from_end_to_end_is_ignored():
    findings = find_control(x=make_noise(1.0), y=STROKE)
    assert findings.moved_control.control == "Y"


def test_an_axis_that_drifts_is_ignored():
    drift = np.linspace(-1, 1, 500)
    still = np.zeros(450)
    assert find_control(x=drift, y=np.concatenate([still, STROKE])).moved_control.control == "Y"


def test_a_single_wrong_reading_is_ignored():
    glitch = STILL.copy()
    glitch[25] = 1.0
    assert find_control(x=glitch).moved_control is None


def test_two_controls_that_move_together_are_both_reported():
    findings = find_control(x=STROKE, y=0.8 * STROKE)
    assert findings.moved_control is None
    assert "X (Stick) and Y (Stick) moved together" in findings.message


def test_of_a_trigger_with_axis_and_button_the_wanted_kind_is_found():
    signals = {"x": STROKE, "button_1": range(25, 40)}
    assert "1 (Stick)" in find_control(**signals).message
    assert find_control(**signals, wanted_kind=ControlKind.AXIS).moved_control.control == "X"
    assert find_control(**signals, wanted_kind=ControlKind.BUTTON).moved_control.control == "1"


def test_a_shaken_stick_is_found_too():
    shaken = [sin(2 * pi * 2 * count / 100) for count in range(50)]
    assert find_control(x=shaken).moved_control.control == "X"


def test_a_hat_of_a_silent_device_is_found_when_held_briefly():
    detection = ControlDetector([STICK, PEDAL])
    assert detection.find_moved_control(0.0).moved_control is None
    detection.feed("a", InputReading(0.0, (0.0, nan), (False, False)))
    detection.feed("b", InputReading(0.0, (-1.0,), ()))
    detection.feed("a", InputReading(5.0, (-1.0, nan), (False, False)))
    assert detection.find_moved_control(5.01).moved_control is None
    assert detection.find_moved_control(5.05).moved_control == MovedControl(
        "a", "X", ControlKind.AXIS, -1
    )


def test_of_two_devices_the_moved_one_is_found_and_forgotten_after_a_while():
    detection = ControlDetector([STICK, PEDAL])
    detection.feed("a", InputReading(0.0, (0.0, 0.0), (False, False)))
    for time_s, raw in ((0.0, -1.0), (1.0, 1.0), (1.1, -1.0)):
        detection.feed("b", InputReading(time_s, (raw,), ()))
    assert detection.find_moved_control(1.2).moved_control == MovedControl(
        "b", "Brake", ControlKind.AXIS, 1
    )
    assert "axis Brake of Pedal" in detection.find_moved_control(1.2).message
    assert detection.find_moved_control(3.0).moved_control is None
