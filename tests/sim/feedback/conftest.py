"""Fixtures: a robot, a worn robot and their simulated loops."""

from dataclasses import replace

import pytest

from rotemina.sim.feedback import AxisLoop
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

RATE_HZ = 5000.0


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture(scope="session")
def worn_robot(robot):
    """The robot with hysteresis of 12 % and creep of 2 % per decade on zn."""
    effects = (
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    )
    return replace(robot, effects=effects)


@pytest.fixture(scope="session")
def loop(robot):
    return AxisLoop(robot, "zn", RATE_HZ)


@pytest.fixture(scope="session")
def worn_loop(worn_robot):
    return AxisLoop(worn_robot, "zn", RATE_HZ)
