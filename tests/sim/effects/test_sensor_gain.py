"""Gain error of a sensor: it is proportional, has either sign and changes only the reading."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize("error", [-0.3, -0.02, 0.02, 0.5])
def test_the_error_is_proportional_to_the_position(error):
    time_s = np.arange(2000) / 2000
    command = 5e-4 + 3e-4 * np.sin(2 * np.pi * 20 * time_s**2)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="sensor_gain", parameters={"error": error})
    response = simulate(ROBOT, [effect], record)
    true = response.signal("thx", Tap.REF)
    np.testing.assert_allclose(response.signal("thx", Tap.MEAS), (1 + error) * true, rtol=1e-13)
