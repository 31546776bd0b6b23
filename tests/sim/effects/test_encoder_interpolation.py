"""Errors of an encoder within its grating's period: locked to the true position."""

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
PERIOD = 20e-6
AMPLITUDES = {"sine": 2e-7, "cosine": -1e-7, "second_sine": 5e-8, "second_cosine": 3e-8}


def moved(speed, others=(), **parameters):
    time_s = np.arange(4000) / 2000
    command = 0.02 + speed * np.minimum(time_s, 2.0 - time_s)  # there and back
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="encoder_interpolation", parameters=parameters)
    return simulate(ROBOT, [*others, effect], record)


@pytest.mark.parametrize("speed", [1e-5, 1.37e-4, 5e-3])
def test_the_error_belongs_to_the_true_position_at_any_speed_and_either_way(speed):
    answer = moved(speed, period=PERIOD, **AMPLITUDES)
    true = answer.signal("x", Tap.REF)
    phase = 2 * np.pi * true / PERIOD
    expected = (
        2e-7 * np.sin(phase) - 1e-7 * np.cos(phase)
        + 5e-8 * np.sin(2 * phase) + 3e-8 * np.cos(2 * phase)
    )  # fmt: skip
    np.testing.assert_allclose(answer.signal("x", Tap.MEAS) - true, expected, atol=1e-15)


def test_its_frequency_scales_with_speed():
    lines = []
    for speed in (1e-3, 2e-3):
        answer = moved(speed, period=PERIOD, second_sine=0.0)
        error = (answer.signal("x", Tap.MEAS) - answer.signal("x", Tap.REF))[200:1800]
        spectrum = np.abs(np.fft.rfft(error * np.hanning(1600)))
        lines.append(np.argmax(spectrum) * 2000 / 1600)
    assert lines == [50.0, 100.0]


def test_it_follows_the_position_and_not_what_another_fault_makes_of_the_reading():
    gain = AxisEffect(axis="x", id="sensor_gain", parameters={"error": 0.01})
    answer = moved(1e-3, [gain], period=PERIOD, second_sine=0.0)
    true = answer.signal("x", Tap.REF)
    error = answer.signal("x", Tap.MEAS) - 1.01 * true
    np.testing.assert_allclose(error, 1e-7 * np.sin(2 * np.pi * true / PERIOD), atol=1e-15)
