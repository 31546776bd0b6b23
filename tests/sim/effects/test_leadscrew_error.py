"""Lead screw error: locked to position, so its frequency grows with speed; linear in amplitudes."""

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.harmonics import two_harmonics
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
MIDDLE = sum(ROBOT.axes["x"].range) / 2


def added(command, rate_hz=1000.0, **parameters):
    """Return position without the effect, and what the effect adds."""
    record = Record.from_signals(
        np.arange(len(command)) / rate_hz, {("x", Tap.CMD): command}, {"x": "m"}
    )
    effect = AxisEffect(axis="x", id="leadscrew_error", parameters=parameters)
    nominal = simulate(ROBOT, (), record).signal("x", Tap.REF)
    return nominal, simulate(ROBOT, [effect], record).signal("x", Tap.REF) - nominal


def test_it_is_the_series_of_the_position():
    figures = {"sine": 2e-6, "cosine": -1e-6, "sine_2": 5e-7, "cosine_2": 3e-7, "period": 8e-4}
    q, error = added(np.linspace(0.01, 0.02, 4000), **figures)
    angle = 2 * np.pi * (q - MIDDLE) / 8e-4
    expected = 2e-6 * np.sin(angle) - 1e-6 * np.cos(angle)
    expected += 5e-7 * np.sin(2 * angle) + 3e-7 * np.cos(2 * angle)
    np.testing.assert_allclose(error, expected, atol=1e-16)


@pytest.mark.parametrize("speed", [1e-3, 2e-3, 5e-3])
def test_its_frequency_is_speed_over_pitch(speed):
    rate_hz, rows = 1000.0, 8000
    _, error = added(0.005 + speed * np.arange(rows) / rate_hz, rate_hz)
    spectrum = np.abs(np.fft.rfft(error * np.hanning(rows)))
    found = np.fft.rfftfreq(rows, 1 / rate_hz)[spectrum.argmax()]
    assert found == pytest.approx(speed / ROBOT.axes["x"].pitch, abs=0.13)


def test_the_same_place_has_the_same_error_whichever_way_it_is_reached():
    there = np.linspace(0.02, 0.0213, 4000)
    q, error = added(np.concatenate([there, there[::-1]]), rate_hz=200.0)
    back = np.interp(q[1000:3000], q[4000:][::-1], error[4000:][::-1])
    np.testing.assert_allclose(error[1000:3000], back, atol=2e-9)


def test_it_does_not_depend_on_time():
    rest, error = added(np.full(500, 0.0123))
    assert np.ptp(error) < 1e-18
    assert np.ptp(rest) < 1e-15


def test_amplitudes_are_linear():
    command = np.linspace(0.01, 0.013, 2000)
    one = added(command, sine=2e-6, cosine_2=1e-6)[1]
    two = added(command, sine=4e-6, cosine_2=2e-6)[1]
    np.testing.assert_allclose(two, 2 * one, atol=1e-16)


def test_no_amplitude_is_the_nominal_axis():
    assert np.abs(added(np.linspace(0.01, 0.013, 2000), sine=0.0)[1]).max() == 0.0


def test_the_preset_is_one_pitch():
    attached = Attached.of(ROBOT, AxisEffect(axis="x", id="leadscrew_error"))
    assert attached.values["period"] == pytest.approx(ROBOT.axes["x"].pitch)


def test_plain_python_says_the_same_as_compiled():
    effect = AxisEffect(axis="x", id="leadscrew_error", parameters={"sine_2": 1e-6})
    attached = Attached.of(ROBOT, effect)
    numbers = list(attached.formulation.numbers(attached.values, attached.facts))
    q, error = added(np.linspace(0.01, 0.013, 500), sine_2=1e-6)
    plain = [two_harmonics(x, 0.0, 0.0, 0.0, 0.0, 0.0, numbers, []) - x for x in q]
    np.testing.assert_allclose(plain, error, atol=1e-16)
