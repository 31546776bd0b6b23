"""Amplifier lag: exact for held inputs, with the gain and phase of the low pass, also in u."""

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects.amplifier_lag import (
    apply_first_order_lag,
    apply_second_order_lag,
    apply_third_order_lag,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
LAGS = [
    ("first_order", {"time_constant": 2e-3}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 0.3}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 1.0}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 3.0}),
    ("third_order", {"time_constant": 1e-3, "damping_ratio": 0.5, "ratio": 1.0}),
    ("third_order", {"time_constant": 1e-3, "damping_ratio": 0.3, "ratio": 4.0}),
]
STEPS = {
    "first_order": apply_first_order_lag,
    "second_order": apply_second_order_lag,
    "third_order": apply_third_order_lag,
}
every_lag = pytest.mark.parametrize(("formulation", "parameters"), LAGS)


def make_transfer_function(parameters):
    """Return numerator and denominator of the transfer function."""
    period = parameters["time_constant"]
    if "damping_ratio" not in parameters:
        return [1.0], [period, 1.0]
    denominator = [period**2, 2 * parameters["damping_ratio"] * period, 1.0]
    if "ratio" in parameters:
        denominator = np.polymul(denominator, [parameters["ratio"] * period, 1.0])
    return [1.0], denominator


def simulate_axis(command, rate_hz, formulation=None, parameters=None, axis="thx"):
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: ROBOT.axes[axis].unit})
    effects = []
    if formulation:
        effects = [
            AxisEffect(
                axis=axis, id="amplifier_lag", formulation=formulation, parameters=parameters
            )
        ]
    return simulate(ROBOT, effects, record)


@every_lag
@pytest.mark.parametrize("h", [1e-5, 1e-3, 0.1])
def test_output_and_mean_under_held_inputs_are_exact_at_any_step(formulation, parameters, h):
    step = STEPS[formulation]
    x = np.random.default_rng(1).normal(size=20)
    fine = 4000
    time_s = np.arange(20 * fine + 1) * h / fine
    held = np.append(np.repeat(x, fine), x[-1])
    y = lsim(make_transfer_function(parameters), held, time_s, interp=False)[1]
    p, s = list(parameters.values()), [0.0] * 4
    means, outputs = [], []
    for value in x:
        means.append(step(value, 0.0, 0.0, h, 0.0, 0.0, p, s))
        outputs.append(step(99.0, 0.0, 0.0, 0.0, 0.0, 0.0, p, s))
    np.testing.assert_allclose(outputs, y[fine::fine], atol=1e-9)
    trapezoid = 0.5 * (y[1:] + y[:-1]).reshape(20, fine).mean(axis=1)
    np.testing.assert_allclose(means, trapezoid, atol=2e-4 if h > 0.01 else 1e-6)


@every_lag
def test_the_tap_at_u_has_the_gain_and_phase_of_the_low_pass(formulation, parameters):
    rate_hz, frequency_hz = 4000.0, 100.0
    time_s = np.arange(8000) / rate_hz
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    lagged = simulate_axis(command, rate_hz, formulation, parameters)
    clean = simulate_axis(command, rate_hz)
    rotation = np.exp(-2j * np.pi * frequency_hz * time_s)[4000:]
    jw = 2j * np.pi * frequency_hz
    numerator, denominator = make_transfer_function(parameters)
    expected = np.polyval(numerator, jw) / np.polyval(denominator, jw)
    for tap, hold_response in ((Tap.REF, 1.0), (Tap.U, np.exp(-jw / 2 / rate_hz))):
        ratio = np.sum(lagged.signal("thx", tap)[4000:] * rotation)
        ratio /= np.sum(clean.signal("thx", tap)[4000:] * rotation)
        assert abs(ratio - expected * hold_response) < 5e-3 * abs(expected)
    assert np.angle(expected) < -0.5
    assert abs(expected) < 0.9 or parameters["damping_ratio"] <= 0.5  # resonant


@every_lag
def test_the_motion_does_not_depend_on_the_sample_rate(formulation, parameters):
    command = np.repeat([1e-4, 6e-4, 3e-4], 40)
    fine = simulate_axis(np.repeat(command, 200), 40_000.0, formulation, parameters)
    coarse = simulate_axis(command, 200.0, formulation, parameters)
    gap = coarse.signal("thx", Tap.REF) - fine.signal("thx", Tap.REF)[::200]
    assert np.abs(gap).max() < 2.5e-3 * 5e-4


def test_the_error_of_held_means_is_of_second_order():
    command = np.repeat([1e-4, 6e-4], 4)
    errors, parameters = [], {"time_constant": 2e-3}
    finest = simulate_axis(np.repeat(command, 3200), 640_000.0, "first_order", parameters)
    for repeats in (200, 400):  # finer than the inner step of 1/12 000 s
        record = simulate_axis(
            np.repeat(command, repeats), 200.0 * repeats, "first_order", parameters
        )
        gap = record.signal("thx", Tap.REF)[::repeats] - finest.signal("thx", Tap.REF)[::3200]
        errors.append(np.abs(gap).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.15)


def test_the_response_is_continuous_down_to_no_lag():
    command = 5e-4 + 4e-4 * np.sign(np.sin(2 * np.pi * 5.0 * np.arange(400) / 1000))
    clean = simulate_axis(command, 1000.0).signal("thx", Tap.REF)
    for formulation in STEPS:
        without_lag = simulate_axis(command, 1000.0, formulation, {"time_constant": 0.0})
        small_lag = simulate_axis(command, 1000.0, formulation, {"time_constant": 1e-9})
        np.testing.assert_array_equal(without_lag.signal("thx", Tap.REF), clean)
        assert np.abs(small_lag.signal("thx", Tap.REF) - clean).max() < 1e-8


def test_a_run_starts_at_rest_on_piezo_and_stepper():
    for axis, position in (("thx", 4e-4), ("x", 0.02)):
        record = simulate_axis(
            np.full(50, position), 1000.0, "second_order", {"time_constant": 5e-3}, axis
        )
        np.testing.assert_allclose(record.signal(axis, Tap.REF), position, rtol=1e-9)


def test_the_response_is_continuous_at_critical_damping():
    outputs = []
    for ratio in (1 - 1e-9, 1.0, 1 + 1e-9):
        s = [0.0, 0.0]
        outputs.append([apply_second_order_lag(1.0, 0, 0, 1e-3, 0, 0, [1e-3, ratio], s), *s])
    np.testing.assert_allclose(outputs[0], outputs[1], atol=1e-8)
    np.testing.assert_allclose(outputs[2], outputs[1], atol=1e-8)
