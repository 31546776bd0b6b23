"""Low pass of a sensor: exact at any rate, without effect on the motion."""

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects.sensor_lag import (
    apply_first_order_lag,
    apply_second_order_lag,
    apply_third_order_lag,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
FILTERS = [
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
every_filter = pytest.mark.parametrize(("formulation", "parameters"), FILTERS)


def make_transfer_function(parameters):
    """Return numerator and denominator of the transfer function."""
    period = parameters["time_constant"]
    if "damping_ratio" not in parameters:
        return [1.0], [period, 1.0]
    denominator = [period**2, 2 * parameters["damping_ratio"] * period, 1.0]
    if "ratio" in parameters:
        denominator = np.polymul(denominator, [parameters["ratio"] * period, 1.0])
    return [1.0], denominator


def simulate_axis(formulation, parameters, command, rate_hz, axis="thx"):
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: "rad"})
    effect = AxisEffect(axis=axis, id="sensor_lag", formulation=formulation, parameters=parameters)
    return simulate(ROBOT, [effect], record)


@every_filter
@pytest.mark.parametrize("h", [1e-5, 1e-3, 0.1])
def test_along_straight_lines_the_filters_are_exact_at_any_step(formulation, parameters, h):
    step = STEPS[formulation]
    x = np.interp(np.arange(200) * h, [0, 20 * h, 90 * h, 200 * h], [0.0, 1.0, -1.0, 0.5])
    p, s = list(parameters.values()), [0.0] * 4
    y = [step(value, value, 0.0, h, 0.0, 0.0, p, s) for value in x]
    expected = lsim(make_transfer_function(parameters), x, np.arange(200) * h)[1]
    np.testing.assert_allclose(y, expected, atol=1e-9)


@every_filter
def test_an_evaluation_without_time_does_not_advance_the_filter(formulation, parameters):
    step = STEPS[formulation]
    p, s = list(parameters.values()), [0.0] * 4
    y = step(1.0, 1.0, 0.0, 1e-3, 0.0, 0.0, p, s)
    state_before = list(s)
    assert step(5.0, 5.0, 0.0, 0.0, 0.0, 0.0, p, s) == y
    assert s == state_before


@every_filter
def test_gain_and_phase_of_the_reading_are_those_of_the_low_pass(formulation, parameters):
    rate_hz, frequency_hz = 4000.0, 100.0
    time_s = np.arange(8000) / rate_hz
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    response = simulate_axis(formulation, parameters, command, rate_hz)
    rotation = np.exp(-2j * np.pi * frequency_hz * time_s)[4000:]
    ratio = np.sum(response.signal("thx", Tap.MEAS)[4000:] * rotation)
    ratio /= np.sum(response.signal("thx", Tap.REF)[4000:] * rotation)
    numerator, denominator = make_transfer_function(parameters)
    jw = 2j * np.pi * frequency_hz
    expected = np.polyval(numerator, jw) / np.polyval(denominator, jw)
    assert abs(ratio - expected) < 2e-3 * abs(expected)


@every_filter
@pytest.mark.parametrize("rate_hz", [200.0, 1000.0])
def test_the_reading_of_a_ringing_axis_does_not_depend_on_the_rate(
    formulation, parameters, rate_hz
):
    """Samples at these rates cannot show the 300 Hz of the axis, but the sensor follows it."""
    command = np.repeat([1e-4, 6e-4, 3e-4], int(rate_hz / 5))
    repeats = round(40_000 / rate_hz)
    fine = simulate_axis(formulation, parameters, np.repeat(command, repeats), rate_hz * repeats)
    expected = fine.signal("thx", Tap.MEAS)[::repeats]
    coarse = simulate_axis(formulation, parameters, command, rate_hz).signal("thx", Tap.MEAS)
    assert np.abs(coarse - expected).max() < 2e-3 * 5e-4
    assert np.ptp(expected[int(rate_hz / 5) : int(rate_hz / 5) + 4]) > 1e-4


def test_the_response_is_continuous_down_to_no_lag():
    command = 5e-4 + 4e-4 * np.sign(np.sin(2 * np.pi * 5.0 * np.arange(500) / 1000))
    for formulation in STEPS:
        clean = simulate_axis(formulation, {"time_constant": 0.0}, command, 1000.0)
        near = simulate_axis(formulation, {"time_constant": 1e-9}, command, 1000.0)
        gap = near.signal("thx", Tap.MEAS) - clean.signal("thx", Tap.MEAS)
        np.testing.assert_array_equal(clean.signal("thx", Tap.MEAS), clean.signal("thx", Tap.REF))
        assert np.abs(gap).max() < 2e-8


def test_the_response_is_continuous_at_critical_damping():
    command = np.repeat([1e-4, 6e-4], 100)
    responses = [
        simulate_axis(
            "second_order", {"time_constant": 2e-3, "damping_ratio": ratio}, command, 1000.0
        )
        for ratio in (1 - 1e-9, 1.0, 1 + 1e-9)
    ]
    for other in responses[1:]:
        np.testing.assert_allclose(
            other.signal("thx", Tap.MEAS), responses[0].signal("thx", Tap.MEAS), atol=1e-11
        )
