"""An axis to be tuned, with little to be simulated."""

from dataclasses import replace

import pytest

from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.tuning.search_problem import TuningProblem

RATE_HZ = 5000.0


@pytest.fixture(scope="session")
def worn():
    effects = (
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    )
    return replace(load_robot("rotemina"), effects=effects)


@pytest.fixture(scope="session")
def problem(worn):
    return TuningProblem(worn, "zn", RATE_HZ)
