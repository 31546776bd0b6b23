"""Effects on inputs without memory: saturation, quantization, gain error, bowed curves."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

PICMA, ROBOT, EMPS = load_robot("picma"), load_robot("rotemina"), load_robot("emps")
SPAN, GAIN = 46.5e-6, 12.53e-6
RAMP = np.linspace(0.0, 3.7 * GAIN, 2001)


def simulate_axis(effect, formulation=None, command=RAMP, tap=Tap.REF, **parameters):
    time_s = np.arange(len(command)) / 200.0
    record = Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"})
    axis_effect = AxisEffect(axis="p", id=effect, formulation=formulation, parameters=parameters)
    return simulate(PICMA, [axis_effect], record).signal("p", tap)


def test_saturation_acts_only_near_the_limits():
    u = simulate_axis("saturation", tap=Tap.U, low_margin=0.2, high_margin=0.5)
    np.testing.assert_allclose(u, np.clip(RAMP / GAIN, 0.2, 3.2), atol=1e-12)


def test_soft_saturation_approaches_the_hard_one():
    hard = simulate_axis("saturation")
    for softness, max_gap in ((0.0, 0.0), (1e-9, 1e-9 * SPAN), (1e-3, 1e-3 * SPAN)):
        assert (
            np.abs(simulate_axis("saturation", "soft", softness=softness) - hard).max() <= max_gap
        )


@pytest.mark.parametrize("formulation", ["hard", "soft"])
def test_saturation_outside_the_range_has_no_effect(formulation):
    parameters = {"low_margin": 0.0, "high_margin": 0.0}
    if formulation == "soft":
        parameters = {"low_margin": -1.8, "high_margin": -1.8, "softness": 0.01}
    np.testing.assert_allclose(
        simulate_axis("saturation", formulation, **parameters), RAMP, atol=1e-15
    )


def test_quantization_makes_even_steps_from_the_low_end():
    u = simulate_axis("quantization", tap=Tap.U, step=0.1)
    np.testing.assert_allclose(np.unique(np.rint(u / 0.1)), np.arange(38))
    assert np.abs(u / 0.1 - np.rint(u / 0.1)).max() < 1e-12
    assert np.abs(u - RAMP / GAIN).max() <= 0.05 + 1e-12
    np.testing.assert_allclose(simulate_axis("quantization", step=0.0), RAMP, rtol=1e-15)


def test_steps_are_filtered_by_the_mechanics():
    command = 4e-4 + 1e-6 * np.arange(400)
    record = Record.from_signals(
        np.arange(400) / 2000.0, {("thx", Tap.CMD): command}, {"thx": "rad"}
    )
    quantization = AxisEffect(axis="thx", id="quantization", parameters={"step": 4.0})
    response = simulate(ROBOT, [quantization], record)
    u, q = response.signal("thx", Tap.U), response.signal("thx", Tap.REF)
    assert set(np.round(np.diff(u), 9)) == {0.0, 4.0}
    assert np.mean(np.abs(np.diff(q)) < 1e-9) < 0.1


def test_gain_error_is_proportional_to_the_command():
    np.testing.assert_allclose(simulate_axis("gain_error", error=-0.07), 0.93 * RAMP, rtol=1e-12)
    np.testing.assert_allclose(simulate_axis("gain_error", error=0.0), RAMP, rtol=1e-15)


@pytest.mark.parametrize(
    ("formulation", "parameters"),
    [
        ("polynomial", {"bow": 0.05, "s_shape": 0.0}),
        ("polynomial", {"bow": 0.0, "s_shape": 0.03}),
        ("polynomial", {"bow": -0.2, "s_shape": 0.0}),
        ("exponential", {"curvature": 1.5}),
    ],
)
def test_curves_are_exact_at_the_ends_and_bend_between(formulation, parameters):
    command = np.linspace(0.0, SPAN, 2001)
    y = simulate_axis("static_nonlinearity", formulation, command, **parameters)
    np.testing.assert_allclose(y[[0, -1]], [0.0, SPAN], atol=1e-18)
    assert np.diff(y).min() > 0.0
    bend = (y - command) / SPAN
    if "curvature" in parameters:
        slopes = np.diff(y)
        assert np.log(slopes[-1] / slopes[0]) == pytest.approx(1.5, rel=1e-2)
    elif parameters["bow"]:
        assert bend[1000] == pytest.approx(parameters["bow"])
        np.testing.assert_allclose(bend, bend[::-1], atol=1e-12)
    else:
        assert np.abs(bend).max() == pytest.approx(0.03, rel=1e-4)
        np.testing.assert_allclose(bend, -bend[::-1], atol=1e-12)


def test_the_response_is_continuous_at_a_straight_curve():
    straight = simulate_axis("static_nonlinearity", bow=0.0, s_shape=0.0)
    np.testing.assert_allclose(straight, RAMP, atol=1e-18)
    for curvature in (0.0, 1e-12, -1e-9):
        y = simulate_axis("static_nonlinearity", "exponential", curvature=curvature)
        np.testing.assert_allclose(y, RAMP, atol=1e-9 * SPAN)


def test_the_nonlinearity_of_a_force_axis_acts_on_its_voltage():
    time_s = np.arange(200) * 1e-3
    signals = {("q", Tap.CMD): np.full(200, 0.1), ("q", Tap.U): np.zeros(200)}
    record = Record.from_signals(time_s, signals, {"q": "m"}, {"mode": "open_loop"})
    nonlinearity = AxisEffect(axis="q", id="static_nonlinearity", parameters={"bow": 0.02})
    gap = simulate(EMPS, [nonlinearity], record).signal("q", Tap.REF)
    gap = gap - simulate(EMPS, [], record).signal("q", Tap.REF)
    axis = EMPS.axes["q"]
    force, lag = 0.02 * 20.0 * axis.gain, axis.mass / axis.damping
    exact = force / axis.damping * (time_s - lag * (1 - np.exp(-time_s / lag)))
    np.testing.assert_allclose(gap, exact, atol=1e-12)


def test_soft_saturation_is_the_published_curve():
    margin, softness = 0.2, 0.1
    u = simulate_axis(
        "saturation", "soft", tap=Tap.U, low_margin=margin, high_margin=margin, softness=0.1
    )
    v = (RAMP / GAIN - 1.85) / (1.85 - margin)
    expected = v * (1 + np.abs(v) ** (1 / softness)) ** -softness
    np.testing.assert_allclose((u - 1.85) / (1.85 - margin), expected, atol=1e-12)
