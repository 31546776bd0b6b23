"""Fixtures: solutions of the default plate, computed once for all tests."""

import pytest

from rotemina.sim.plate import clamp_plate, compute_eigenmodes, solve_unit_motions
from rotemina.sim.robot import Plate


@pytest.fixture(scope="package")
def solutions():
    return solve_unit_motions(clamp_plate(Plate()))


@pytest.fixture(scope="package")
def modes(solutions):
    return compute_eigenmodes(solutions.clamped, 0.04, 4)
