"""Simulated machines with known sensor errors."""

import numpy as np
import pytest

from rotemina.sim.calibration import make_calibration_motion
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate


@pytest.fixture(scope="session")
def robot():
    return load_robot("rotemina")


@pytest.fixture(scope="session")
def simulate_calibration(robot):
    """Return a function that simulates an axis with effects (id, formulation, parameters)."""

    def simulate_axis(axis, *effects, runs=3, seed=1, rate_hz=500.0, **plan):
        axis_effects = [
            AxisEffect(axis=axis, id=name, formulation=formulation, parameters=values)
            for name, formulation, values in effects
        ]
        motion = make_calibration_motion(robot, axis, runs=runs, rate_hz=rate_hz, **plan)
        return simulate(robot, axis_effects, motion, np.random.default_rng(seed))

    return simulate_axis
