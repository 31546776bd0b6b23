"""An amplifier's bandwidth: exact for held inputs, phase and gain both fall, u shows it."""

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects.amplifier_lag import first_order, second_order, third_order
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
LAGS = [
    ("first_order", {"time_constant": 2e-3}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 0.3}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 1.0}),
    ("second_order", {"time_constant": 1e-3, "damping_ratio": 3.0}),
    ("third_order", {"time_constant": 1e-3, "damping_ratio": 0.5, "ratio": 1.0}),
    ("third_order", {"time_constant": 1e-3, "damping_ratio": 0.3, "ratio": 4.0}),
]
STEPS = {"first_order": first_order, "second_order": second_order, "third_order": third_order}
every_lag = pytest.mark.parametrize(("formulation", "parameters"), LAGS)


def transfer(parameters):
    """Numerator and denominator."""
    period = parameters["time_constant"]
    if "damping_ratio" not in parameters:
        return [1.0], [period, 1.0]
    below = [period**2, 2 * parameters["damping_ratio"] * period, 1.0]
    if "ratio" in parameters:
        below = np.polymul(below, [parameters["ratio"] * period, 1.0])
    return [1.0], below


def driven(command, rate_hz, formulation=None, parameters=None, axis="thx"):
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
    y = lsim(transfer(parameters), held, time_s, interp=False)[1]
    p, s = list(parameters.values()), [0.0] * 4
    mean, after = [], []
    for value in x:
        mean.append(step(value, 0.0, 0.0, h, 0.0, 0.0, p, s))
        after.append(step(99.0, 0.0, 0.0, 0.0, 0.0, 0.0, p, s))
    np.testing.assert_allclose(after, y[fine::fine], atol=1e-9)
    trapezoid = 0.5 * (y[1:] + y[:-1]).reshape(20, fine).mean(axis=1)
    np.testing.assert_allclose(mean, trapezoid, atol=2e-4 if h > 0.01 else 1e-6)


@every_lag
def test_the_tap_at_u_has_the_gain_and_phase_of_the_low_pass(formulation, parameters):
    rate_hz, frequency_hz = 4000.0, 100.0
    time_s = np.arange(8000) / rate_hz
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * frequency_hz * time_s)
    lagged = driven(command, rate_hz, formulation, parameters)
    clean = driven(command, rate_hz)
    turning = np.exp(-2j * np.pi * frequency_hz * time_s)[4000:]
    jw = 2j * np.pi * frequency_hz
    above, below = transfer(parameters)
    expected = np.polyval(above, jw) / np.polyval(below, jw)
    for tap, held in ((Tap.REF, 1.0), (Tap.U, np.exp(-jw / 2 / rate_hz))):
        ratio = np.sum(lagged.signal("thx", tap)[4000:] * turning)
        ratio /= np.sum(clean.signal("thx", tap)[4000:] * turning)
        assert abs(ratio - expected * held) < 5e-3 * abs(expected)
    assert np.angle(expected) < -0.5
    assert abs(expected) < 0.9 or parameters["damping_ratio"] <= 0.5  # rings


@every_lag
def test_an_axis_recorded_coarsely_moves_as_one_recorded_finely(formulation, parameters):
    command = np.repeat([1e-4, 6e-4, 3e-4], 40)
    fine = driven(np.repeat(command, 200), 40_000.0, formulation, parameters)
    coarse = driven(command, 200.0, formulation, parameters)
    gap = coarse.signal("thx", Tap.REF) - fine.signal("thx", Tap.REF)[::200]
    assert np.abs(gap).max() < 2.5e-3 * 5e-4


def test_the_error_of_held_means_falls_with_the_square_of_the_step():
    command = np.repeat([1e-4, 6e-4], 4)
    errors, parameters = [], {"time_constant": 2e-3}
    best = driven(np.repeat(command, 3200), 640_000.0, "first_order", parameters)
    for often in (200, 400):  # finer than the inner step of 1/12 000 s
        record = driven(np.repeat(command, often), 200.0 * often, "first_order", parameters)
        gap = record.signal("thx", Tap.REF)[::often] - best.signal("thx", Tap.REF)[::3200]
        errors.append(np.abs(gap).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.15)


def test_without_lag_nothing_changes_and_little_lag_changes_little():
    command = 5e-4 + 4e-4 * np.sign(np.sin(2 * np.pi * 5.0 * np.arange(400) / 1000))
    clean = driven(command, 1000.0).signal("thx", Tap.REF)
    for formulation in STEPS:
        none = driven(command, 1000.0, formulation, {"time_constant": 0.0})
        little = driven(command, 1000.0, formulation, {"time_constant": 1e-9})
        np.testing.assert_array_equal(none.signal("thx", Tap.REF), clean)
        assert np.abs(little.signal("thx", Tap.REF) - clean).max() < 1e-8


def test_a_run_starts_at_rest_and_a_stepper_may_lag_too():
    for axis, at in (("thx", 4e-4), ("x", 0.02)):
        record = driven(np.full(50, at), 1000.0, "second_order", {"time_constant": 5e-3}, axis)
        np.testing.assert_allclose(record.signal(axis, Tap.REF), at, rtol=1e-9)


def test_damping_ratios_about_the_critical_one_give_one_answer():
    answers = []
    for ratio in (1 - 1e-9, 1.0, 1 + 1e-9):
        s = [0.0, 0.0]
        answers.append([second_order(1.0, 0, 0, 1e-3, 0, 0, [1e-3, ratio], s), *s])
    np.testing.assert_allclose(answers[0], answers[1], atol=1e-8)
    np.testing.assert_allclose(answers[2], answers[1], atol=1e-8)
