"""Lead screw error: a function of position, so its frequency grows with speed."""

import numpy as np
import pytest

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.effects.harmonics import add_two_harmonics
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
MIDDLE = sum(ROBOT.axes["x"].range) / 2


def simulate_error(command, rate_hz=1000.0, **parameters):
    """Return the position without the effect, and the error that the effect adds."""
    record = Record.from_signals(
        np.arange(len(command)) / rate_hz, {("x", Tap.CMD): command}, {"x": "m"}
    )
    effect = AxisEffect(axis="x", id="leadscrew_error", parameters=parameters)
    nominal = simulate(ROBOT, (), record).signal("x", Tap.REF)
    return nominal, simulate(ROBOT, [effect], record).signal("x", Tap.REF) - nominal


def test_the_error_is_a_fourier_series_of_the_position():
    parameters = {"sine": 2e-6, "cosine": -1e-6, "sine_2": 5e-7, "cosine_2": 3e-7, "period": 8e-4}
    q, error = simulate_error(np.linspace(0.01, 0.02, 4000), **parameters)
    angle = 2 * np.pi * (q - MIDDLE) / 8e-4
    expected = 2e-6 * np.sin(angle) - 1e-6 * np.cos(angle)
    expected += 5e-7 * np.sin(2 * angle) + 3e-7 * np.cos(2 * angle)
    np.testing.assert_allclose(error, expected, atol=1e-16)


@pytest.mark.parametrize("speed", [1e-3, 2e-3, 5e-3])
def test_the_frequency_of_the_error_is_speed_over_pitch(speed):
    rate_hz, rows = 1000.0, 8000
    _, error = simulate_error(0.005 + speed * np.arange(rows) / rate_hz, rate_hz)
    spectrum = np.abs(np.fft.rfft(error * np.hanning(rows)))
    frequency_hz = np.fft.rfftfreq(rows, 1 / rate_hz)[spectrum.argmax()]
    assert frequency_hz == pytest.approx(speed / ROBOT.axes["x"].pitch, abs=0.13)


def test_the_error_at_a_position_is_the_same_from_both_directions():
    forward_path = np.linspace(0.02, 0.0213, 4000)
    q, error = simulate_error(np.concatenate([forward_path, forward_path[::-1]]), rate_hz=200.0)
    error_on_return = np.interp(q[1000:3000], q[4000:][::-1], error[4000:][::-1])
    np.testing.assert_allclose(error[1000:3000], error_on_return, atol=2e-9)


def test_the_error_does_not_depend_on_time():
    position, error = simulate_error(np.full(500, 0.0123))
    assert np.ptp(error) < 1e-18
    assert np.ptp(position) < 1e-15


def test_the_error_is_linear_in_the_amplitudes():
    command = np.linspace(0.01, 0.013, 2000)
    single = simulate_error(command, sine=2e-6, cosine_2=1e-6)[1]
    double = simulate_error(command, sine=4e-6, cosine_2=2e-6)[1]
    np.testing.assert_allclose(double, 2 * single, atol=1e-16)


def test_zero_amplitude_is_the_nominal_axis():
    assert np.abs(simulate_error(np.linspace(0.01, 0.013, 2000), sine=0.0)[1]).max() == 0.0


def test_the_preset_period_is_one_pitch():
    attached = AttachedEffect.of(ROBOT, AxisEffect(axis="x", id="leadscrew_error"))
    assert attached.values["period"] == pytest.approx(ROBOT.axes["x"].pitch)


def test_plain_python_and_compiled_agree():
    effect = AxisEffect(axis="x", id="leadscrew_error", parameters={"sine_2": 1e-6})
    attached = AttachedEffect.of(ROBOT, effect)
    numbers = list(attached.formulation.compute_numbers(attached.values, attached.facts))
    q, error = simulate_error(np.linspace(0.01, 0.013, 500), sine_2=1e-6)
    plain = [add_two_harmonics(x, 0.0, 0.0, 0.0, 0.0, 0.0, numbers, []) - x for x in q]
    np.testing.assert_allclose(plain, error, atol=1e-16)
