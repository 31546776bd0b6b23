"""A slew limit: no effect below the rate, and a triangle far above it."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotemina.sim.effects.slew_limit import limit_rate, limit_rate_softly
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def simulate_axis(command, rate_hz, formulation=None, **parameters):
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effects = []
    if formulation:
        effects = [
            AxisEffect(axis="thx", id="slew_limit", formulation=formulation, parameters=parameters)
        ]
    return simulate(ROBOT, effects, record)


def make_sine(amplitude, frequency_hz, rate_hz=20_000.0, count=20_000):
    time_s = np.arange(count) / rate_hz
    return 5.8e-4 + amplitude * np.sin(2 * np.pi * frequency_hz * time_s)


@pytest.mark.parametrize("x", [0.4, -3.0])
@pytest.mark.parametrize("h", [1e-3, 0.2, 5.0])
def test_the_mean_of_the_hard_limit_is_exact(x, h):
    s = [0.0]
    time_s = (np.arange(200_000) + 0.5) / 200_000 * h
    path = np.sign(x) * np.minimum(2.0 * time_s, abs(x))
    assert limit_rate(x, 0, 0, h, 0, 0, [2.0], s) == pytest.approx(path.mean(), rel=1e-6)
    assert s[0] == pytest.approx(np.sign(x) * min(2.0 * h, abs(x)))
    assert limit_rate(9.0, 0, 0, 0.0, 0, 0, [2.0], s) == s[0]


@pytest.mark.parametrize("x", [1e-3, -0.5, 30.0, -1000.0])
@pytest.mark.parametrize("h", [1e-4, 0.1])
def test_the_soft_limit_and_its_mean_follow_their_differential_equation(x, h):
    p, s = [100.0, 1e-2], [0.0]
    mean = limit_rate_softly(x, 0, 0, h, 0, 0, p, s)

    def compute_derivative(_t, y):
        return [p[0] * np.tanh((x - y[0]) / (p[0] * p[1])), y[0]]

    end = solve_ivp(compute_derivative, (0, h), [0.0, 0.0], rtol=1e-10, atol=1e-13 * abs(x)).y[
        :, -1
    ]
    assert s[0] == pytest.approx(end[0], rel=1e-7)
    assert mean == pytest.approx(end[1] / h, rel=1e-6)


def test_there_is_no_effect_below_the_rate():
    command = make_sine(5e-4, 1.0)
    fastest = 2 * np.pi * 1.0 * 5e-4 / ROBOT.axes["thx"].gain
    without_limit, above, below = (
        simulate_axis(command, 20_000.0, formulation, rate=ratio * fastest).signal("thx", Tap.REF)
        for formulation, ratio in ((None, 0.0), ("hard", 1.05), ("hard", 0.8))
    )
    assert np.abs(above - without_limit).max() < 1e-3 * 5e-4
    assert np.abs(below - without_limit).max() > 1e-2 * 5e-4


@pytest.mark.parametrize("formulation", ["hard", "soft"])
def test_far_above_the_rate_a_sine_becomes_a_triangle(formulation):
    gain, frequency_hz, rate = ROBOT.axes["thx"].gain, 20.0, 500.0
    record = simulate_axis(make_sine(5e-4, frequency_hz), 20_000.0, formulation, rate=rate)
    u = record.signal("thx", Tap.U)[-1001:]  # a period
    slopes = np.abs(np.diff(u)) * 20_000.0
    assert slopes.max() <= rate * (1 + 1e-9)
    assert np.mean(slopes > 0.98 * rate) > 0.9
    assert np.ptp(u) == pytest.approx(rate / (2 * frequency_hz), rel=0.02)
    assert np.ptp(u) < 0.3 * 1e-3 / gain


@pytest.mark.parametrize("formulation", ["hard", "soft"])
def test_the_motion_does_not_depend_on_the_sample_rate(formulation):
    command = np.repeat([1e-4, 6e-4, 3e-4], 40)
    fine = simulate_axis(np.repeat(command, 200), 40_000.0, formulation, rate=5e4)
    coarse = simulate_axis(command, 200.0, formulation, rate=5e4)
    gap = coarse.signal("thx", Tap.REF) - fine.signal("thx", Tap.REF)[::200]
    assert np.abs(gap).max() < 2.5e-3 * 5e-4
