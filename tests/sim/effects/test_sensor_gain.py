"""A sensor of another sensitivity: proportional, of either sign, on the reading alone."""

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize("error", [-0.3, -0.02, 0.02, 0.5])
def test_the_reading_is_off_in_proportion_to_the_position(error):
    time_s = np.arange(2000) / 2000
    command = 5e-4 + 3e-4 * np.sin(2 * np.pi * 20 * time_s**2)
    record = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="sensor_gain", parameters={"error": error})
    answer = simulate(ROBOT, [effect], record)
    true = answer.signal("thx", Tap.REF)
    np.testing.assert_allclose(answer.signal("thx", Tap.MEAS), (1 + error) * true, rtol=1e-13)
