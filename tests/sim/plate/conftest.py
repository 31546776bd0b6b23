"""The shipped plate, solved once."""

import pytest

from rotemina.sim.plate.modes import eigenmodes
from rotemina.sim.plate.statics import hold, solve
from rotemina.sim.robot.plate import Plate


@pytest.fixture(scope="package")
def solutions():
    return solve(hold(Plate()))


@pytest.fixture(scope="package")
def modes(solutions):
    return eigenmodes(solutions.held, 0.04, 4)
