"""Vibration: locked to time, not to position or command."""

import numpy as np
import pytest

from rotemina.sim.effects.vibration import tone, two_tones
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
TONE = {"frequency": 37.0, "sine": 2e-6, "cosine": -1e-6}
HARMONIC = {"sine_2": 5e-7, "cosine_2": 3e-7}


def shaken(command, formulation="tone", first_s=0.0, **parameters):
    time_s = first_s + np.arange(len(command)) / 1000.0
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="vibration", formulation=formulation, parameters=parameters)
    after, before = (simulate(ROBOT, used, record) for used in ([effect], ()))
    return after.signal("x", Tap.REF) - before.signal("x", Tap.REF)


@pytest.mark.parametrize("first_s", [0.0, 500.0])
def test_it_is_the_series_of_the_time_since_the_run_began(first_s):
    angle = 2 * np.pi * 37.0 * np.arange(2000) / 1000.0
    expected = 2e-6 * np.sin(angle) - 1e-6 * np.cos(angle)
    one = shaken(np.full(2000, 0.02), first_s=first_s, **TONE)
    np.testing.assert_allclose(one, expected, atol=1e-15)
    expected += 5e-7 * np.sin(2 * angle) + 3e-7 * np.cos(2 * angle)
    two = shaken(np.full(2000, 0.02), "two_tones", first_s, **TONE, **HARMONIC)
    np.testing.assert_allclose(two, expected, atol=1e-15)


@pytest.mark.parametrize("speed", [0.0, 1e-3, 5e-3])
def test_its_frequency_does_not_grow_with_speed(speed):
    added = shaken(0.01 + speed * np.arange(4000) / 1000.0, **TONE)
    spectrum = np.abs(np.fft.rfft(added))
    assert np.fft.rfftfreq(4000, 1e-3)[spectrum.argmax()] == pytest.approx(37.0)


def test_amplitudes_are_linear_and_nothing_is_nominal():
    command = np.full(500, 0.02)
    double = {**TONE, "sine": 4e-6, "cosine": -2e-6}
    np.testing.assert_allclose(shaken(command, **double), 2 * shaken(command, **TONE), atol=1e-17)
    assert np.abs(shaken(command, sine=0.0)).max() == 0.0


def test_plain_python_says_the_same():
    one = tone(1.0, 0.0, 0.25, 0.0, 0.0, 0.0, [2 * np.pi, 0.5, 0.1], [])
    assert one == pytest.approx(1.5)
    two = two_tones(1.0, 0.0, 0.25, 0.0, 0.0, 0.0, [2 * np.pi, 0.5, 0.1, 0.3, 0.2], [])
    assert two == pytest.approx(1.3)
