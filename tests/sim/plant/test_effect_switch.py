"""Effects switched and tuned in mid-run: the axes go on from where they are."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.plant.effect_switch import taken_over
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
CENTRE = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
THX = AXES.index("thx")
LOOP = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1e-4})


def plant_with(*effects):
    return Plant.of(replace(ROBOT, effects=effects))


def moving(time_s):
    command = np.tile(CENTRE, (len(time_s), 1))
    command[:, THX] += 3e-4 * np.sin(2 * np.pi * 2.0 * time_s)
    return command


def halves(before, after, signal="position"):
    """Run for a second in two halves, changing over in mid-move; return a signal (n, axes)."""
    time_s = np.arange(1000) / 1000.0
    command = moving(time_s)
    state = before.at_rest(0.0, command[0])
    first, state = before.advance(state, time_s[:437], command[:437])
    second, _ = after.advance(taken_over(after, before, state), time_s[437:], command[437:])
    return np.concatenate([getattr(first, signal), getattr(second, signal)])


def whole(plant):
    time_s = np.arange(1000) / 1000.0
    command = moving(time_s)
    return plant.advance(plant.at_rest(0.0, command[0]), time_s, command)[0].position


def test_changing_over_to_the_same_effects_changes_nothing():
    effects = (LOOP, AxisEffect(axis="x", id="backlash", parameters={"width": 1e-5}))
    np.testing.assert_allclose(
        halves(plant_with(*effects), plant_with(*effects)),
        whole(plant_with(*effects)),
        rtol=0,
        atol=1e-15,
    )


def test_an_effect_switched_off_leaves_the_nominal_motion_once_vibration_has_died():
    left = halves(plant_with(LOOP), plant_with())[-200:, THX]
    np.testing.assert_allclose(left, whole(plant_with())[-200:, THX], atol=2e-3 * 1e-4)


def test_a_tuned_effect_keeps_its_memory():
    wider = replace(LOOP, parameters={"width": 1.0001e-4})
    gap = np.abs(halves(plant_with(LOOP), plant_with(wider)) - whole(plant_with(LOOP)))
    assert 0.0 < gap[:, THX].max() < 1e-3 * 1e-4


def test_creep_that_is_tuned_goes_on_at_its_new_pace():
    slow = AxisEffect(axis="thx", id="creep", parameters={"onset": 10.0})
    fast = replace(slow, parameters={"onset": 0.01})
    time_s = np.arange(1000) / 1000.0
    command = np.tile(CENTRE, (1000, 1))
    command[500:, THX] += 1e-4
    before, after = plant_with(slow), plant_with(fast)
    _, state = before.advance(before.at_rest(0.0, CENTRE), time_s[:437], command[:437])
    motion, _ = after.advance(taken_over(after, before, state), time_s[437:], command[437:])
    alone, _ = after.advance(after.at_rest(0.0, CENTRE), time_s, command)
    np.testing.assert_allclose(motion.position, alone.position[437:], rtol=0, atol=1e-12)


def test_drift_of_a_sensor_that_is_tuned_wanders_at_its_new_level():
    calm = AxisEffect(axis="x", id="sensor_drift", formulation="flicker", parameters={"level": 0.0})
    wild = replace(calm, parameters={"level": 1e-6})
    time_s, chance = np.arange(2000) / 1000.0, Chance(np.random.default_rng(0))
    command = np.tile(CENTRE, (2000, 1))
    before, after = plant_with(calm), plant_with(wild)
    _, state = before.advance(
        before.at_rest(0.0, CENTRE), time_s[:100], command[:100], chance=chance
    )
    state = taken_over(after, before, state)
    motion, _ = after.advance(state, time_s[100:], command[100:], chance=chance)
    wander = motion.reading[:, AXES.index("x")] - motion.position[:, AXES.index("x")]
    assert 5e-7 < wander.std() < 2e-5


@pytest.mark.parametrize("formulation", ["first_order", "second_order"])
def test_a_sensor_lag_tuned_up_from_nothing_begins_at_what_the_sensor_read(formulation):
    none = AxisEffect(
        axis="thx",
        id="sensor_lag",
        formulation=formulation,
        parameters={"time_constant": 0.0},
    )
    some = replace(none, parameters={"time_constant": 2e-4})
    gap = np.abs(halves(plant_with(none), plant_with(some), "reading") - whole(plant_with(none)))
    assert 0.0 < gap[:, THX].max() < 1e-2 * 3e-4


@pytest.mark.parametrize("axis", ["thx", "x", "thy"])
def test_a_mode_goes_on_ringing_whatever_else_is_tuned(axis):
    static = replace(ROBOT.axes["thy"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "thy": static}, couplings=())
    modes = tuple(
        AxisEffect(axis=axis, id="flexible_mode", parameters={"share": 0.3, "frequency": hertz})
        for hertz in (20.0, 33.0)
    )
    leak = AxisEffect(axis="zn", id="cross_coupling", formulation="mode", from_axis=axis)
    new = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.0})
    before = Plant.of(replace(robot, effects=(leak, *modes)))
    after = Plant.of(replace(robot, effects=(*modes, new, leak)))
    time_s = np.arange(1000) / 1000.0
    command = np.tile(CENTRE, (1000, 1))
    command[100:, AXES.index(axis)] += 1e-5
    _, state = before.advance(before.at_rest(0.0, CENTRE), time_s[:437], command[:437])
    expected, _ = before.advance(state, time_s[437:], command[437:])
    motion, _ = after.advance(taken_over(after, before, state), time_s[437:], command[437:])
    np.testing.assert_allclose(motion.position, expected.position, rtol=0, atol=1e-14)


def test_a_new_effect_does_not_move_other_axes():
    new = AxisEffect(axis="x", id="backlash", parameters={"width": 1e-5})
    gap = np.abs(halves(plant_with(LOOP), plant_with(LOOP, new)) - whole(plant_with(LOOP)))
    others = [column for column in range(len(AXES)) if AXES[column] != "x"]
    assert gap[:, others].max() < 1e-12


def test_speed_is_carried_over():
    time_s = np.arange(100) / 1000.0
    command = moving(time_s)
    before, after = plant_with(), plant_with(LOOP)
    _, state = before.advance(before.at_rest(0.0, command[0]), time_s, command)
    at = after.assembly.machine.axis["rate"][THX]
    assert taken_over(after, before, state).x[at] == state.x[at] != 0.0
