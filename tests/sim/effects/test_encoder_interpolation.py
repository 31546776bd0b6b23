"""Errors of an encoder within the period of its grating: a function of the true position."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
PERIOD = 20e-6
AMPLITUDES = {"sine": 2e-7, "cosine": -1e-7, "second_sine": 5e-8, "second_cosine": 3e-8}


def simulate_motion(speed, others=(), **parameters):
    time_s = np.arange(4000) / 2000
    command = 0.02 + speed * np.minimum(time_s, 2.0 - time_s)  # there and back
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="encoder_interpolation", parameters=parameters)
    return simulate(ROBOT, [*others, effect], record)


@pytest.mark.parametrize("speed", [1e-5, 1.37e-4, 5e-3])
def test_the_error_depends_on_the_true_position_at_any_speed_in_both_directions(speed):
    response = simulate_motion(speed, period=PERIOD, **AMPLITUDES)
    true = response.signal("x", Tap.REF)
    phase = 2 * np.pi * true / PERIOD
    expected = (
        2e-7 * np.sin(phase) - 1e-7 * np.cos(phase)
        + 5e-8 * np.sin(2 * phase) + 3e-8 * np.cos(2 * phase)
    )  # fmt: skip
    np.testing.assert_allclose(response.signal("x", Tap.MEAS) - true, expected, atol=1e-15)


def test_the_frequency_of_the_error_scales_with_speed():
    peaks_hz = []
    for speed in (1e-3, 2e-3):
        response = simulate_motion(speed, period=PERIOD, second_sine=0.0)
        error = (response.signal("x", Tap.MEAS) - response.signal("x", Tap.REF))[200:1800]
        spectrum = np.abs(np.fft.rfft(error * np.hanning(1600)))
        peaks_hz.append(np.argmax(spectrum) * 2000 / 1600)
    assert peaks_hz == [50.0, 100.0]


def test_the_error_depends_on_the_position_and_not_on_a_faulty_reading():
    gain = AxisEffect(axis="x", id="sensor_gain", parameters={"error": 0.01})
    response = simulate_motion(1e-3, [gain], period=PERIOD, second_sine=0.0)
    true = response.signal("x", Tap.REF)
    error = response.signal("x", Tap.MEAS) - 1.01 * true
    np.testing.assert_allclose(error, 1e-7 * np.sin(2 * np.pi * true / PERIOD), atol=1e-15)
