"""Simulated machines whose sensors are known to be wrong."""

import numpy as np
import pytest

from rotemina.sim.calibration.plan import calibration_motion
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture(scope="session")
def measured(robot):
    """Return the record of an axis with effects: (id, parameters) each, by their formulation."""

    def make(axis, *effects, runs=3, seed=1, rate_hz=500.0, **plan):
        present = [
            AxisEffect(axis=axis, id=name, formulation=form, parameters=values)
            for name, form, values in effects
        ]
        motion = calibration_motion(robot, axis, runs=runs, rate_hz=rate_hz, **plan)
        return simulate(robot, present, motion, np.random.default_rng(seed))

    return make
