"""The worn machine is the nominal one with wear, and its motions are allowed."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records import Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate
from rotemina.sim.trajectory import dry_run, load_worn_effects, make_demonstration
from rotemina.sim.trajectory.worn_machine_demo import WORN_ROBOT

ROBOT = load_robot("rotemina")


def test_the_worn_machine_is_the_nominal_one_with_wear():
    worn_robot = load_robot(WORN_ROBOT)
    assert replace(worn_robot, name=ROBOT.name, effects=()) == ROBOT
    assert load_worn_effects(ROBOT) == worn_robot.effects
    assert {effect.id for effect in worn_robot.effects} == {
        *("hysteresis", "creep", "backlash", "leadscrew_error", "flexible_mode", "thermal_drift")
    }
    assert load_worn_effects(load_robot("picma")) == ()


@pytest.mark.parametrize("pace", [1.0, 0.83])
def test_the_demonstration_is_allowed_and_shows_the_wear(pace):
    commands = make_demonstration(ROBOT, pace)
    assert dry_run(ROBOT, commands).allowed
    record = simulate(ROBOT, load_worn_effects(ROBOT), commands, np.random.default_rng(1))
    gap = record.signal("zn", Tap.MEAS) - record.signal("zn", Tap.CMD)
    floor = ROBOT.axes["zn"].sensor.noise_floor
    assert np.std(gap) > 50.0 * floor


def test_another_pace_is_another_motion():
    commands = [make_demonstration(ROBOT, pace).signal("zn", Tap.CMD) for pace in (1.0, 0.83)]
    assert np.abs(commands[0] - commands[1]).max() > 1e-5
