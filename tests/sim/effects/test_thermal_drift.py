"""Thermal drift: grows without motion, settles, and knows nothing of the command."""

import numpy as np
import pytest

from rotemina.sim.effects.thermal_drift import warm_up
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import Simulation, simulate

ROBOT = load_robot("rotemina")
EFFECT = AxisEffect(
    axis="thx", id="thermal_drift", parameters={"amplitude": 1e-5, "time_constant": 2.0}
)


def record_of(command, first_s=0.0):
    time_s = first_s + np.arange(len(command)) / 500.0
    return Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})


def drift(command, first_s=0.0, effect=EFFECT):
    record = record_of(command, first_s)
    after, before = (simulate(ROBOT, used, record) for used in ([effect], ()))
    return after.signal("thx", Tap.REF) - before.signal("thx", Tap.REF)


@pytest.mark.parametrize("first_s", [0.0, 1000.0])
def test_it_follows_the_exponential_from_the_start_of_the_run(first_s):
    time_s = np.arange(5000) / 500.0
    expected = 1e-5 * (1 - np.exp(-time_s / 2.0))
    np.testing.assert_allclose(drift(np.full(5000, 5e-4), first_s), expected, atol=1e-15)


def test_it_is_the_same_whatever_the_command():
    still = drift(np.full(2000, 5e-4))
    moving = drift(5e-4 + 3e-4 * np.sin(np.arange(2000) / 30.0))
    np.testing.assert_allclose(still, moving, atol=1e-17)


def test_a_run_in_pieces_goes_on_drifting():
    whole = record_of(np.full(1000, 5e-4))
    simulation = Simulation(ROBOT, [EFFECT], whole)
    later = record_of(np.full(500, 5e-4), 1.0)
    simulation.follow(record_of(np.full(500, 5e-4)))
    path = simulation.follow(later).signal("thx", Tap.REF)
    expected = simulate(ROBOT, [EFFECT], whole).signal("thx", Tap.REF)[500:]
    np.testing.assert_allclose(path, expected, atol=1e-16)


def test_no_amplitude_is_the_nominal_axis():
    none = AxisEffect(axis="thx", id="thermal_drift", parameters={"amplitude": 0.0})
    assert np.abs(drift(np.full(100, 5e-4), effect=none)).max() == 0.0


def test_plain_python_says_the_same():
    assert warm_up(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, [0.5, 2.0], []) == 1.0
    later = warm_up(1.0, 0.0, 2.0, 0.0, 0.0, 0.0, [0.5, 2.0], [])
    assert later == pytest.approx(1.0 + 0.5 * (1 - np.exp(-1.0)))
