"""The worn machine is the nominal one with wear, and its motions may be played."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.simulation.simulation import simulate
from rotemina.sim.trajectory.dry_run import dry_run
from rotemina.sim.trajectory.worn_machine_demo import WORN, demonstration, worn_effects

ROBOT = load_robot("rotemina")


def test_the_worn_machine_is_the_nominal_one_with_wear():
    worn = load_robot(WORN)
    assert replace(worn, name=ROBOT.name, effects=()) == ROBOT
    assert worn_effects(ROBOT) == worn.effects
    assert {one.id for one in worn.effects} == {
        *("hysteresis", "creep", "backlash", "leadscrew_error", "flexible_mode", "thermal_drift")
    }
    assert worn_effects(load_robot("picma")) == ()


@pytest.mark.parametrize("pace", [1.0, 0.83])
def test_its_motions_may_be_played_and_show_the_wear(pace):
    asked = demonstration(ROBOT, pace)
    assert dry_run(ROBOT, asked).allowed
    real = simulate(ROBOT, worn_effects(ROBOT), asked, np.random.default_rng(1))
    gap = real.signal("zn", Tap.MEAS) - real.signal("zn", Tap.CMD)
    floor = ROBOT.axes["zn"].sensor.noise_floor
    assert np.std(gap) > 50.0 * floor


def test_another_pace_is_another_motion():
    ways = [demonstration(ROBOT, pace).signal("zn", Tap.CMD) for pace in (1.0, 0.83)]
    assert np.abs(ways[0] - ways[1]).max() > 1e-5
