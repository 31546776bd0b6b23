"""Axes to close loops around."""

from dataclasses import replace

import pytest

from rotemina.sim.feedback.axis_loop import AxisLoop
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

RATE_HZ = 5000.0


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture(scope="session")
def worn(robot):
    """The robot with hysteresis of 12 % and creep of 2 % per decade on its nano Z."""
    effects = (
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    )
    return replace(robot, effects=effects)


@pytest.fixture(scope="session")
def loop(robot):
    return AxisLoop(robot, "zn", RATE_HZ)


@pytest.fixture(scope="session")
def worn_loop(worn):
    return AxisLoop(worn, "zn", RATE_HZ)
