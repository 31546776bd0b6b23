"""Vibration: a function of time, independent of position and command."""

import numpy as np
import pytest

from rotemina.sim.effects.vibration import add_tone, add_two_tones
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
TONE = {"frequency": 37.0, "sine": 2e-6, "cosine": -1e-6}
HARMONIC = {"sine_2": 5e-7, "cosine_2": 3e-7}


def simulate_vibration(command, formulation="tone", first_s=0.0, **parameters):
    time_s = first_s + np.arange(len(command)) / 1000.0
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="vibration", formulation=formulation, parameters=parameters)
    after, before = (simulate(ROBOT, effects, record) for effects in ([effect], ()))
    return after.signal("x", Tap.REF) - before.signal("x", Tap.REF)


@pytest.mark.parametrize("first_s", [0.0, 500.0])
def test_vibration_is_a_fourier_series_of_the_time_since_the_start(first_s):
    angle = 2 * np.pi * 37.0 * np.arange(2000) / 1000.0
    expected = 2e-6 * np.sin(angle) - 1e-6 * np.cos(angle)
    one_tone = simulate_vibration(np.full(2000, 0.02), first_s=first_s, **TONE)
    np.testing.assert_allclose(one_tone, expected, atol=1e-15)
    expected += 5e-7 * np.sin(2 * angle) + 3e-7 * np.cos(2 * angle)
    two_tones = simulate_vibration(np.full(2000, 0.02), "two_tones", first_s, **TONE, **HARMONIC)
    np.testing.assert_allclose(two_tones, expected, atol=1e-15)


@pytest.mark.parametrize("speed", [0.0, 1e-3, 5e-3])
def test_the_frequency_does_not_depend_on_the_speed(speed):
    vibration = simulate_vibration(0.01 + speed * np.arange(4000) / 1000.0, **TONE)
    spectrum = np.abs(np.fft.rfft(vibration))
    assert np.fft.rfftfreq(4000, 1e-3)[spectrum.argmax()] == pytest.approx(37.0)


def test_vibration_is_linear_in_the_amplitudes_and_zero_is_nominal():
    command = np.full(500, 0.02)
    double = {**TONE, "sine": 4e-6, "cosine": -2e-6}
    np.testing.assert_allclose(
        simulate_vibration(command, **double), 2 * simulate_vibration(command, **TONE), atol=1e-17
    )
    assert np.abs(simulate_vibration(command, sine=0.0)).max() == 0.0


def test_plain_python_adds_the_tones():
    one_tone = add_tone(1.0, 0.0, 0.25, 0.0, 0.0, 0.0, [2 * np.pi, 0.5, 0.1], [])
    assert one_tone == pytest.approx(1.5)
    two_tones = add_two_tones(1.0, 0.0, 0.25, 0.0, 0.0, 0.0, [2 * np.pi, 0.5, 0.1, 0.3, 0.2], [])
    assert two_tones == pytest.approx(1.3)
