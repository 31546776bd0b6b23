"""Creep: a straight line over the logarithm of time after each move."""

import numpy as np
import pytest

from rotemina.sim.effects import AxisProperties
from rotemina.sim.effects.creep import CREEP, apply_relaxations
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT, PICMA = load_robot("rotemina"), load_robot("picma")
RATE_HZ = 200.0


def compute_creep(command, rate_hz=RATE_HZ, robot=PICMA, **parameters):
    axis = next(name for name in robot.axes if name in ("p", "thx"))
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(
        time_s, {(axis, Tap.CMD): command}, {axis: robot.axes[axis].unit or "m"}
    )
    creep = AxisEffect(axis=axis, id="creep", parameters=parameters)
    positions = [
        simulate(robot, effects, record).signal(axis, Tap.REF) for effects in ([creep], [])
    ]
    return positions[0] - positions[1]


def make_step_command(low, high, seconds=100.0, rate_hz=RATE_HZ):
    command = np.full(int(seconds * rate_hz), high)
    command[:10] = low
    return command


@pytest.mark.parametrize("onset", [1e-3, 0.1, 1.0])
def test_the_sum_of_relaxations_is_the_logarithm_from_10_ms_to_1000_s(onset):
    properties = AxisProperties.of(PICMA.axes["p"])
    p = CREEP.formulations[0].compute_numbers({"rate": 1.0, "onset": onset}, properties)
    s, time_s = [0.0] * CREEP.formulations[0].acts.states, np.geomspace(1e-2, 1e3, 200)
    outputs, previous_s = [], 0.0
    for t in time_s:
        apply_relaxations(1.0, 0, previous_s, t - previous_s, 0, 0, p, s)
        outputs.append(apply_relaxations(1.0, 0, t, 0.0, 0, 0, p, s) - 1.0)
        previous_s = t
    error = np.abs(np.array(outputs) - np.log10(1 + time_s / onset))
    assert error[time_s <= 2e5 * onset].max() < 2e-3
    assert error.max() < 2e-2


@pytest.mark.parametrize("h", [1e-3, 1.0, 100.0])
def test_the_output_is_the_mean_while_the_input_is_held(h):
    p = CREEP.formulations[0].compute_numbers(
        {"rate": 1.0, "onset": 0.1}, AxisProperties.of(PICMA.axes["p"])
    )
    coarse, fine = [0.0] * 40, [0.0] * 40
    means = [apply_relaxations(1.0, 0, 0, h / 4000, 0, 0, p, fine) for _ in range(4000)]
    assert apply_relaxations(1.0, 0, 0, h, 0, 0, p, coarse) == pytest.approx(
        np.mean(means), rel=1e-9
    )
    np.testing.assert_allclose(coarse[:12], fine[:12], rtol=1e-9)


@pytest.mark.parametrize("move", [-1e-5, 2e-5])
def test_creep_grows_by_its_rate_per_decade_in_proportion_to_the_move(move):
    gap = compute_creep(make_step_command(2e-5, 2e-5 + move), rate=0.02)
    time_s = (np.arange(len(gap)) - 10) / RATE_HZ
    first, second = np.interp([4.9, 49.9], time_s, gap)  # log10(1 + t/t0) = log10(50), log10(500)
    assert (second - first) / move == pytest.approx(0.02, rel=2e-2)
    assert gap[9] == 0.0


def test_static_and_dynamic_axes_creep_alike():
    static = compute_creep(make_step_command(1e-5, 3e-5, 5.0, 2000.0), 2000.0) / 2e-5
    moving = compute_creep(make_step_command(2e-4, 6e-4, 5.0, 2000.0), 2000.0, ROBOT) / 4e-4
    np.testing.assert_allclose(moving[1000:], static[1000:], rtol=1e-3)
