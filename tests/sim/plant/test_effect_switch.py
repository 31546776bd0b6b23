"""Effects that are switched or tuned during a run: the axes continue from their state."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.plant import Plant, RandomStreams, transfer_state
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
CENTRE = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
THX = AXES.index("thx")
HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1e-4})


def build_plant(*effects):
    return Plant.of(replace(ROBOT, effects=effects))


def make_motion(time_s):
    command = np.tile(CENTRE, (len(time_s), 1))
    command[:, THX] += 3e-4 * np.sin(2 * np.pi * 2.0 * time_s)
    return command


def run_with_switch(before, after, signal="position"):
    """Run for a second, switch plants during the move, and return a signal (n, axes)."""
    time_s = np.arange(1000) / 1000.0
    command = make_motion(time_s)
    state = before.find_rest_state(0.0, command[0])
    first, state = before.advance(state, time_s[:437], command[:437])
    second, _ = after.advance(transfer_state(after, before, state), time_s[437:], command[437:])
    return np.concatenate([getattr(first, signal), getattr(second, signal)])


def run_without_switch(plant):
    time_s = np.arange(1000) / 1000.0
    command = make_motion(time_s)
    return plant.advance(plant.find_rest_state(0.0, command[0]), time_s, command)[0].position


def test_switching_to_the_same_effects_changes_nothing():
    effects = (HYSTERESIS, AxisEffect(axis="x", id="backlash", parameters={"width": 1e-5}))
    np.testing.assert_allclose(
        run_with_switch(build_plant(*effects), build_plant(*effects)),
        run_without_switch(build_plant(*effects)),
        rtol=0,
        atol=1e-15,
    )


def test_the_motion_is_nominal_some_time_after_an_effect_is_switched_off():
    position = run_with_switch(build_plant(HYSTERESIS), build_plant())[-200:, THX]
    np.testing.assert_allclose(
        position, run_without_switch(build_plant())[-200:, THX], atol=2e-3 * 1e-4
    )


def test_a_tuned_effect_keeps_its_memory():
    wider = replace(HYSTERESIS, parameters={"width": 1.0001e-4})
    gap = np.abs(
        run_with_switch(build_plant(HYSTERESIS), build_plant(wider))
        - run_without_switch(build_plant(HYSTERESIS))
    )
    assert 0.0 < gap[:, THX].max() < 1e-3 * 1e-4


def test_tuned_creep_continues_at_its_new_rate():
    slow = AxisEffect(axis="thx", id="creep", parameters={"onset": 10.0})
    fast = replace(slow, parameters={"onset": 0.01})
    time_s = np.arange(1000) / 1000.0
    command = np.tile(CENTRE, (1000, 1))
    command[500:, THX] += 1e-4
    before, after = build_plant(slow), build_plant(fast)
    _, state = before.advance(before.find_rest_state(0.0, CENTRE), time_s[:437], command[:437])
    motion, _ = after.advance(transfer_state(after, before, state), time_s[437:], command[437:])
    without_switch, _ = after.advance(after.find_rest_state(0.0, CENTRE), time_s, command)
    np.testing.assert_allclose(motion.position, without_switch.position[437:], rtol=0, atol=1e-12)


def test_tuned_sensor_drift_continues_at_its_new_level():
    no_drift = AxisEffect(
        axis="x", id="sensor_drift", formulation="flicker", parameters={"level": 0.0}
    )
    strong_drift = replace(no_drift, parameters={"level": 1e-6})
    time_s, streams = np.arange(2000) / 1000.0, RandomStreams(np.random.default_rng(0))
    command = np.tile(CENTRE, (2000, 1))
    before, after = build_plant(no_drift), build_plant(strong_drift)
    _, state = before.advance(
        before.find_rest_state(0.0, CENTRE), time_s[:100], command[:100], random_streams=streams
    )
    state = transfer_state(after, before, state)
    motion, _ = after.advance(state, time_s[100:], command[100:], random_streams=streams)
    drift = motion.reading[:, AXES.index("x")] - motion.position[:, AXES.index("x")]
    assert 5e-7 < drift.std() < 2e-5


def test_a_sensor_lag_that_is_tuned_up_from_zero_starts_at_the_reading():
    no_lag = AxisEffect(
        axis="thx",
        id="sensor_lag",
        formulation="second_order",
        parameters={"time_constant": 0.0},
    )
    small_lag = replace(no_lag, parameters={"time_constant": 2e-4})
    gap = np.abs(
        run_with_switch(build_plant(no_lag), build_plant(small_lag), "reading")
        - run_without_switch(build_plant(no_lag))
    )
    assert 0.0 < gap[:, THX].max() < 1e-2 * 3e-4


@pytest.mark.parametrize("axis", ["thx", "x", "thy"])
def test_a_mode_continues_to_ring_when_other_effects_change(axis):
    static = replace(ROBOT.axes["thy"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "thy": static}, couplings=())
    modes = tuple(
        AxisEffect(
            axis=axis, id="flexible_mode", parameters={"share": 0.3, "frequency": frequency_hz}
        )
        for frequency_hz in (20.0, 33.0)
    )
    coupling = AxisEffect(axis="zn", id="cross_coupling", formulation="mode", from_axis=axis)
    gain_error = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.0})
    before = Plant.of(replace(robot, effects=(coupling, *modes)))
    after = Plant.of(replace(robot, effects=(*modes, gain_error, coupling)))
    time_s = np.arange(1000) / 1000.0
    command = np.tile(CENTRE, (1000, 1))
    command[100:, AXES.index(axis)] += 1e-5
    _, state = before.advance(before.find_rest_state(0.0, CENTRE), time_s[:437], command[:437])
    expected, _ = before.advance(state, time_s[437:], command[437:])
    motion, _ = after.advance(transfer_state(after, before, state), time_s[437:], command[437:])
    np.testing.assert_allclose(motion.position, expected.position, rtol=0, atol=1e-14)


def test_a_new_effect_does_not_move_other_axes():
    backlash = AxisEffect(axis="x", id="backlash", parameters={"width": 1e-5})
    gap = np.abs(
        run_with_switch(build_plant(HYSTERESIS), build_plant(HYSTERESIS, backlash))
        - run_without_switch(build_plant(HYSTERESIS))
    )
    others = [column for column in range(len(AXES)) if AXES[column] != "x"]
    assert gap[:, others].max() < 1e-12
