"""What tests of the boards' driver share: a robot, and a bench to be made of it."""

import pytest

from rotemina.sim.robot.file import load_robot


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")
