"""Thermal drift: it grows without motion, settles, and does not depend on the command."""

import numpy as np
import pytest

from rotemina.sim.effects.thermal_drift import add_warm_up_drift
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import SimulatedMachine, simulate

ROBOT = load_robot("rotemina")
EFFECT = AxisEffect(
    axis="thx", id="thermal_drift", parameters={"amplitude": 1e-5, "time_constant": 2.0}
)


def make_record(command, first_s=0.0):
    time_s = first_s + np.arange(len(command)) / 500.0
    return Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})


def simulate_drift(command, first_s=0.0, effect=EFFECT):
    record = make_record(command, first_s)
    after, before = (simulate(ROBOT, effects, record) for effects in ([effect], ()))
    return after.signal("thx", Tap.REF) - before.signal("thx", Tap.REF)


@pytest.mark.parametrize("first_s", [0.0, 1000.0])
def test_drift_is_an_exponential_from_the_start_of_the_run(first_s):
    time_s = np.arange(5000) / 500.0
    expected = 1e-5 * (1 - np.exp(-time_s / 2.0))
    np.testing.assert_allclose(simulate_drift(np.full(5000, 5e-4), first_s), expected, atol=1e-15)


def test_two_bodies_add_their_exponentials_so_that_the_drift_can_come_back():
    time_s = np.arange(5000) / 500.0
    values = {"amplitude": 1e-5, "time_constant": 0.5}
    values |= {"amplitude_2": -8e-6, "time_constant_2": 4.0}
    effect = AxisEffect(axis="thx", id="thermal_drift", formulation="two_bodies", parameters=values)
    drift = simulate_drift(np.full(5000, 5e-4), effect=effect)
    expected = 1e-5 * (1 - np.exp(-time_s / 0.5)) - 8e-6 * (1 - np.exp(-time_s / 4.0))
    np.testing.assert_allclose(drift, expected, atol=1e-15)
    assert drift[-1] < 0.7 * drift.max()


def test_drift_does_not_depend_on_the_command():
    still = simulate_drift(np.full(2000, 5e-4))
    moving = simulate_drift(5e-4 + 3e-4 * np.sin(np.arange(2000) / 30.0))
    np.testing.assert_allclose(still, moving, atol=1e-17)


def test_drift_continues_in_a_run_in_pieces():
    whole = make_record(np.full(1000, 5e-4))
    simulation = SimulatedMachine(ROBOT, [EFFECT], whole)
    later = make_record(np.full(500, 5e-4), 1.0)
    simulation.follow(make_record(np.full(500, 5e-4)))
    path = simulation.follow(later).signal("thx", Tap.REF)
    expected = simulate(ROBOT, [EFFECT], whole).signal("thx", Tap.REF)[500:]
    np.testing.assert_allclose(path, expected, atol=1e-16)


def test_zero_amplitude_is_the_nominal_axis():
    no_drift = AxisEffect(axis="thx", id="thermal_drift", parameters={"amplitude": 0.0})
    assert np.abs(simulate_drift(np.full(100, 5e-4), effect=no_drift)).max() == 0.0


def test_plain_python_follows_the_exponential():
    assert add_warm_up_drift(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, [0.5, 2.0], []) == 1.0
    later = add_warm_up_drift(1.0, 0.0, 2.0, 0.0, 0.0, 0.0, [0.5, 2.0], [])
    assert later == pytest.approx(1.0 + 0.5 * (1 - np.exp(-1.0)))
