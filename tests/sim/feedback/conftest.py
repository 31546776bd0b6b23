"""Fixtures: a robot, a worn robot and their simulated loops."""

import pytest

from rotemina.sim.feedback import AxisLoop
from rotemina.sim.robot_files import load_robot

RATE_HZ = 5000.0


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture(scope="session")
def loop(robot):
    return AxisLoop(robot, "zn", RATE_HZ)


@pytest.fixture(scope="session")
def worn_loop(worn_robot):
    return AxisLoop(worn_robot, "zn", RATE_HZ)
