"""Effects switched and tuned in mid-run: the axes go on from where they are."""

from dataclasses import replace

import numpy as np

from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.takeover import taken_over
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


def halves(before, after):
    """Run for a second in two halves, changing over in mid-move; return positions (n, axes)."""
    time_s = np.arange(1000) / 1000.0
    command = moving(time_s)
    state = before.at_rest(0.0, command[0])
    first, state = before.advance(state, time_s[:437], command[:437])
    second, _ = after.advance(taken_over(after, before, state), time_s[437:], command[437:])
    return np.concatenate([first.position, second.position])


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
