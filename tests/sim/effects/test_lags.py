"""Lags of amplifier and sensor: exact at any step, with the gain and phase of the low pass."""

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects import amplifier_lag, sensor_lag
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
every_lag = pytest.mark.parametrize(("formulation", "parameters"), LAGS)
one_lag_of_each_order = pytest.mark.parametrize(("formulation", "parameters"), LAGS[::2])
every_step = pytest.mark.parametrize("h", [1e-5, 1e-3, 0.1])


def get_step(module, formulation):
    return getattr(module, f"apply_{formulation}_lag")


def make_transfer_function(parameters):
    """Return numerator and denominator of the transfer function."""
    period = parameters["time_constant"]
    if "damping_ratio" not in parameters:
        return [1.0], [period, 1.0]
    denominator = [period**2, 2 * parameters["damping_ratio"] * period, 1.0]
    if "ratio" in parameters:
        denominator = np.polymul(denominator, [parameters["ratio"] * period, 1.0])
    return [1.0], denominator


def simulate_axis(command, rate_hz, effect_id=None, formulation=None, parameters=None):
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(
        axis="thx", id=effect_id or "", formulation=formulation, parameters=parameters or {}
    )
    return simulate(ROBOT, [effect] if effect_id else (), record)


@every_lag
@every_step
def test_output_and_mean_of_an_amplifier_under_held_inputs_are_exact(formulation, parameters, h):
    step = get_step(amplifier_lag, formulation)
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
@every_step
def test_a_sensor_lag_is_exact_along_straight_lines(formulation, parameters, h):
    step = get_step(sensor_lag, formulation)
    x = np.interp(np.arange(200) * h, [0, 20 * h, 90 * h, 200 * h], [0.0, 1.0, -1.0, 0.5])
    p, s = list(parameters.values()), [0.0] * 4
    y = []
    for value in x:
        y.append(step(value, value, 0.0, h, 0.0, 0.0, p, s))
        state_before = list(s)
        # An evaluation without time does not advance the filter.
        assert step(5.0, 5.0, 0.0, 0.0, 0.0, 0.0, p, s) == y[-1]
        assert s == state_before
    expected = lsim(make_transfer_function(parameters), x, np.arange(200) * h)[1]
    np.testing.assert_allclose(y, expected, atol=1e-9)


@every_lag
@pytest.mark.parametrize("effect_id", ["amplifier_lag", "sensor_lag"])
def test_gain_and_phase_are_those_of_the_low_pass(effect_id, formulation, parameters):
    rate_hz, frequency_hz = 4000.0, 100.0
    time_s = np.arange(8000) / rate_hz
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    lagged = simulate_axis(command, rate_hz, effect_id, formulation, parameters)
    clean = simulate_axis(command, rate_hz)
    rotation = np.exp(-2j * np.pi * frequency_hz * time_s)[4000:]
    jw = 2j * np.pi * frequency_hz
    numerator, denominator = make_transfer_function(parameters)
    expected = np.polyval(numerator, jw) / np.polyval(denominator, jw)
    assert np.angle(expected) < -0.5
    # The amplifier lag acts on the held command, and shows in u and in the motion.
    hold_responses = {Tap.REF: 1.0, Tap.U: np.exp(-jw / 2 / rate_hz)}
    is_amplifier = effect_id == "amplifier_lag"
    taps = hold_responses if is_amplifier else {Tap.MEAS: 1.0}
    bound = 5e-3 if is_amplifier else 2e-3
    for tap, hold_response in taps.items():
        ratio = np.sum(lagged.signal("thx", tap)[4000:] * rotation)
        ratio /= np.sum(clean.signal("thx", tap)[4000:] * rotation)
        assert abs(ratio - expected * hold_response) < bound * abs(expected)


@one_lag_of_each_order
@pytest.mark.parametrize(
    ("effect_id", "tap", "bound"),
    [("amplifier_lag", Tap.REF, 2.5e-3), ("sensor_lag", Tap.MEAS, 2e-3)],
)
def test_the_response_does_not_depend_on_the_sample_rate(
    effect_id, tap, bound, formulation, parameters
):
    """Samples at 200 Hz cannot show the 300 Hz of the axis, but the sensor follows it."""
    command = np.repeat([1e-4, 6e-4, 3e-4], 40)
    fine, coarse = (
        simulate_axis(
            np.repeat(command, repeats), 200.0 * repeats, effect_id, formulation, parameters
        ).signal("thx", tap)[::repeats]
        for repeats in (200, 1)
    )
    assert np.abs(coarse - fine).max() < bound * 5e-4
    assert np.ptp(fine[40:44]) > 1e-4


def test_the_error_of_held_means_is_of_second_order():
    command = np.repeat([1e-4, 6e-4], 4)
    lag = ("amplifier_lag", "first_order", {"time_constant": 2e-3})
    errors = []
    finest = simulate_axis(np.repeat(command, 3200), 640_000.0, *lag)
    for repeats in (200, 400):  # finer than the inner step of 1/12 000 s
        record = simulate_axis(np.repeat(command, repeats), 200.0 * repeats, *lag)
        gap = record.signal("thx", Tap.REF)[::repeats] - finest.signal("thx", Tap.REF)[::3200]
        errors.append(np.abs(gap).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize("module", [amplifier_lag, sensor_lag])
def test_the_response_is_continuous_at_critical_damping(module):
    outputs = []
    for ratio in (1 - 1e-9, 1.0, 1 + 1e-9):
        s = [0.0] * 4
        step = get_step(module, "second_order")
        outputs.append([step(1.0, 1.0, 0, 1e-3, 0, 0, [1e-3, ratio], s), *s])
    np.testing.assert_allclose(outputs[0], outputs[1], atol=1e-8)
    np.testing.assert_allclose(outputs[2], outputs[1], atol=1e-8)


@pytest.mark.parametrize("formulation", ["first_order", "second_order", "third_order"])
def test_a_sensor_lag_vanishes_continuously(formulation):
    command = 5e-4 + 4e-4 * np.sign(np.sin(2 * np.pi * 5.0 * np.arange(500) / 1000))
    clean, near = (
        simulate_axis(command, 1000.0, "sensor_lag", formulation, {"time_constant": lag_s})
        for lag_s in (0.0, 1e-9)
    )
    np.testing.assert_array_equal(clean.signal("thx", Tap.MEAS), clean.signal("thx", Tap.REF))
    gap = near.signal("thx", Tap.MEAS) - clean.signal("thx", Tap.MEAS)
    assert np.abs(gap).max() < 2e-8
