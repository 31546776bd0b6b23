"""The sweep that brings the memory of an inverse and its axis into the same state."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate import (
    Inverse,
    InverseExceedance,
    make_conditioning_sweep,
)
from rotemina.sim.errors import CompensationError
from rotemina.sim.records import Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

ROBOT = load_robot("rotemina")
ZN = ROBOT.axes["zn"]


@pytest.fixture
def model(make_inverse_model):
    return make_inverse_model(
        desired_range=(1e-6, 70e-6),
        consequents=np.array([[0.0, 0.9, 0.1, 0.1]]),
        radii=np.array([0.1, 0.2]),
    )


@pytest.mark.parametrize("start", [20e-6, 45e-6])
def test_the_sweep_nearly_reaches_both_ends_within_all_limits_and_returns(start, model):
    sweep = make_conditioning_sweep(ROBOT, model, start)
    commands = sweep.signal("zn", Tap.CMD)
    assert commands[[0, -1]] == pytest.approx(start, abs=1e-15)
    assert commands.min() < 15e-6
    assert 50e-6 < commands.max() < ZN.range[1]
    assert dry_run(ROBOT, sweep).allowed
    inverse = Inverse(model, 2e-3)
    inverse.run(commands)
    assert not inverse.exceedance & InverseExceedance.COMMAND


def test_the_sweep_erases_the_memory_of_earlier_positions(model):
    sweep = make_conditioning_sweep(ROBOT, model, 30e-6).signal("zn", Tap.CMD)
    commands = []
    for history in ([30e-6], [30e-6, 55e-6, 8e-6, 50e-6, 30e-6]):
        inverse = Inverse(model, 2e-3)
        for position in history:
            command_before = inverse.step(position)
        commands.append((command_before, inverse.run(sweep)[-1]))
    assert abs(commands[0][0] - commands[1][0]) > 1e-6
    assert commands[0][1] == pytest.approx(commands[1][1], abs=1e-15)


def test_a_start_without_a_possible_sweep_is_refused(model):
    with pytest.raises(CompensationError, match=r"between 1 µm and 65 µm"):
        make_conditioning_sweep(ROBOT, model, 70e-6)
    steep = replace(model, consequents=np.array([[0.0, 3.0, 0.1, 0.1]]))
    with pytest.raises(CompensationError, match="move the axis to mid-range first"):
        make_conditioning_sweep(ROBOT, steep, 10e-6)
