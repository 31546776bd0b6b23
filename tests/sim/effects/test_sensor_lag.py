"""A sensor's own low pass: exact answers, at any rate, and the motion untouched."""

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects.sensor_lag import first_order, second_order, third_order
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
FILTERS = [
    ("first_order", {"time_constant": 2e-3}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 0.3}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 1.0}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 3.0}),
    ("third_order", {"time_constant": 1e-3, "damping_ratio": 0.5, "ratio": 1.0}),
    ("third_order", {"time_constant": 1e-3, "damping_ratio": 0.3, "ratio": 4.0}),
]
STEPS = {"first_order": first_order, "second_order": second_order, "third_order": third_order}
every_filter = pytest.mark.parametrize(("formulation", "parameters"), FILTERS)


def transfer(parameters):
    """Numerator and denominator."""
    period = parameters["time_constant"]
    if "damping_ratio" not in parameters:
        return [1.0], [period, 1.0]
    below = [period**2, 2 * parameters["damping_ratio"] * period, 1.0]
    if "ratio" in parameters:
        below = np.polymul(below, [parameters["ratio"] * period, 1.0])
    return [1.0], below


def lagged(formulation, parameters, command, rate_hz, axis="thx"):
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
    expected = lsim(transfer(parameters), x, np.arange(200) * h)[1]
    np.testing.assert_allclose(y, expected, atol=1e-9)


@every_filter
def test_a_reading_between_two_calls_does_not_move_the_filter(formulation, parameters):
    step = STEPS[formulation]
    p, s = list(parameters.values()), [0.0] * 4
    y = step(1.0, 1.0, 0.0, 1e-3, 0.0, 0.0, p, s)
    kept = list(s)
    assert step(5.0, 5.0, 0.0, 0.0, 0.0, 0.0, p, s) == y
    assert s == kept


@every_filter
def test_gain_and_phase_of_the_reading_are_those_of_the_low_pass(formulation, parameters):
    rate_hz, frequency_hz = 4000.0, 100.0
    time_s = np.arange(8000) / rate_hz
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    answer = lagged(formulation, parameters, command, rate_hz)
    turning = np.exp(-2j * np.pi * frequency_hz * time_s)[4000:]
    ratio = np.sum(answer.signal("thx", Tap.MEAS)[4000:] * turning)
    ratio /= np.sum(answer.signal("thx", Tap.REF)[4000:] * turning)
    above, below = transfer(parameters)
    jw = 2j * np.pi * frequency_hz
    expected = np.polyval(above, jw) / np.polyval(below, jw)
    assert abs(ratio - expected) < 2e-3 * abs(expected)


@every_filter
@pytest.mark.parametrize("rate_hz", [200.0, 1000.0])
def test_a_ringing_axis_at_a_low_rate_is_read_as_at_a_fine_one(formulation, parameters, rate_hz):
    """300 Hz of an axis, recorded at less than its period: samples alone would know nothing."""
    command = np.repeat([1e-4, 6e-4, 3e-4], int(rate_hz / 5))
    often = round(40_000 / rate_hz)
    fine = lagged(formulation, parameters, np.repeat(command, often), rate_hz * often)
    expected = fine.signal("thx", Tap.MEAS)[::often]
    coarse = lagged(formulation, parameters, command, rate_hz).signal("thx", Tap.MEAS)
    assert np.abs(coarse - expected).max() < 2e-3 * 5e-4
    assert np.ptp(expected[int(rate_hz / 5) : int(rate_hz / 5) + 4]) > 1e-4


def test_the_answer_is_continuous_down_to_no_lag():
    command = 5e-4 + 4e-4 * np.sign(np.sin(2 * np.pi * 5.0 * np.arange(500) / 1000))
    for formulation in STEPS:
        clean = lagged(formulation, {"time_constant": 0.0}, command, 1000.0)
        near = lagged(formulation, {"time_constant": 1e-9}, command, 1000.0)
        gap = near.signal("thx", Tap.MEAS) - clean.signal("thx", Tap.MEAS)
        np.testing.assert_array_equal(clean.signal("thx", Tap.MEAS), clean.signal("thx", Tap.REF))
        assert np.abs(gap).max() < 2e-8


def test_damping_ratios_about_the_critical_one_give_one_answer():
    command = np.repeat([1e-4, 6e-4], 100)
    read = [
        lagged("second_order", {"time_constant": 2e-3, "damping_ratio": ratio}, command, 1000.0)
        for ratio in (1 - 1e-9, 1.0, 1 + 1e-9)
    ]
    for other in read[1:]:
        np.testing.assert_allclose(
            other.signal("thx", Tap.MEAS), read[0].signal("thx", Tap.MEAS), atol=1e-11
        )
