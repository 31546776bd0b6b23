"""Lost steps: permanent, in multiples of four full steps, and only under load."""

import numpy as np
import pytest

from rotemina.sim.effects.lost_steps import apply_event, apply_overload
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
FOUR_FULL_STEPS_M = 4 * 0.001 / 200
RATE_HZ = 2000.0


def simulate_gap(command, formulation="overload", rate_hz=RATE_HZ, **parameters):
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="lost_steps", formulation=formulation, parameters=parameters)
    with_effect, without = (
        simulate(ROBOT, effects, record).signal("x", Tap.REF) for effects in ([effect], [])
    )
    return with_effect - without


def make_move(speed, ramp_s, seconds=1.0):
    """Return a move that accelerates and decelerates within ``ramp_s``."""
    time_s = np.arange(int((seconds + 0.5) * RATE_HZ)) / RATE_HZ
    up, down = time_s - 0.05, time_s - seconds
    rate = speed * (np.clip(up / ramp_s, 0, 1) - np.clip(down / ramp_s, 0, 1))
    return 0.02 + np.cumsum(rate) / RATE_HZ


def test_a_gentle_move_loses_no_steps():
    assert np.abs(simulate_gap(make_move(5e-3, 0.2))).max() < 1e-14


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_overload_permanently_loses_multiples_of_four_full_steps(sign):
    gap = simulate_gap(make_move(sign * 2.5e-2, 1e-3))
    lost_multiples = gap[-1] / FOUR_FULL_STEPS_M
    assert lost_multiples * sign < -0.5
    assert lost_multiples == pytest.approx(round(lost_multiples), abs=1e-6)
    assert np.ptp(gap[-200:]) < 1e-9


def test_a_stronger_motor_loses_fewer_steps():
    command = make_move(2.5e-2, 1e-3)
    assert abs(simulate_gap(command, limit=20e-6)[-1]) < abs(simulate_gap(command)[-1])
    assert np.abs(simulate_gap(command, limit=200e-6)).max() < 1e-14


def test_a_jump_ends_in_the_nearest_detent():
    s = [0.0]
    for command, expected in ((9e-6, 0.0), (11e-6, -1.0), (1e-3, -50.0)):
        s[0] = 0.0
        apply_overload(command, 0.0, 0, 1e-4, 0, 0, [2 * 5e-6, FOUR_FULL_STEPS_M], s)
        assert s[0] == expected
    state_before = s[0]
    apply_overload(5e-3, 0.0, 0, 0.0, 0, 0, [2 * 5e-6, FOUR_FULL_STEPS_M], s)
    assert s[0] == state_before  # evaluation without advancing time loses no steps


def test_an_event_is_a_permanent_jump_at_its_time():
    gap = simulate_gap(np.full(4000, 0.02), "event", time=0.70015, slips=-2.0)
    assert np.abs(gap[: int(0.7 * RATE_HZ)]).max() == 0.0
    assert gap[-1] == pytest.approx(-2 * FOUR_FULL_STEPS_M, rel=1e-6)
    assert np.abs(simulate_gap(np.full(400, 0.02), "event", time=0.1, slips=0.0)).max() == 0.0


def test_the_mean_over_a_step_depends_linearly_on_the_time_of_the_event():
    p = [[1.0 + k * 1e-4, FOUR_FULL_STEPS_M] for k in range(6)]
    means = [apply_event(0.0, 0, 1.0, 5e-4, 0, 0, numbers, []) for numbers in p]
    np.testing.assert_allclose(means, FOUR_FULL_STEPS_M * (1 - np.arange(6) / 5), atol=1e-12)
    assert apply_event(0.0, 0, 1.0, 0.0, 0, 0, [1.0, FOUR_FULL_STEPS_M], []) == FOUR_FULL_STEPS_M
    assert (
        apply_event(0.0, 0, 0.0, 1e9, 0, 0, [1.0, FOUR_FULL_STEPS_M], []) == 0.0
    )  # the approach before the run starts
