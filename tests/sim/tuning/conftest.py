"""Fixtures: a worn robot, and a tuning problem that is quick to simulate."""

from dataclasses import replace

import pytest

from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.tuning import TuningProblem

RATE_HZ = 5000.0


@pytest.fixture(scope="session")
def worn_robot():
    effects = (
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    )
    return replace(load_robot("rotemina"), effects=effects)


@pytest.fixture(scope="session")
def problem(worn_robot):
    return TuningProblem(worn_robot, "zn", RATE_HZ)
