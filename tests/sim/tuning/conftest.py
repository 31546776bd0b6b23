"""Fixture: a tuning problem that is quick to simulate."""

import pytest

from rotemina.sim.tuning import TuningProblem

RATE_HZ = 5000.0


@pytest.fixture(scope="session")
def problem(worn_robot):
    return TuningProblem(worn_robot, "zn", RATE_HZ)
