"""Comparison of two runs of a machine: the distance of their tips, and refused records."""

import numpy as np
import pytest

from rotemina.sim.comparison import compare_runs
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot


def test_the_path_error_of_two_runs_is_the_distance_of_their_tips():
    robot = load_robot("rotemina")
    time_s = np.arange(101) / 100.0
    positions = {axis: 0.5 * sum(axis_model.range) for axis, axis_model in robot.axes.items()}
    positions["x"] = positions["x"] + 1e-4 * time_s
    runs = [
        Record.from_signals(
            time_s,
            {
                (axis, tap): np.broadcast_to(position, 101) + (offset if axis in "xy" else 0.0)
                for axis, position in positions.items()
                for tap in (Tap.CMD, Tap.MEAS)
            },
            {axis: robot.unit(axis) for axis in robot.axes},
        )
        for offset in (0.0, 3e-6)
    ]
    comparison = compare_runs(robot, *runs)
    assert comparison.path_rms == pytest.approx(2**0.5 * 3e-6)
    assert comparison.path_peak == pytest.approx(2**0.5 * 3e-6)
    commands = Record.from_signals(time_s, {("x", Tap.CMD): time_s}, {"x": "m"})
    with pytest.raises(InputError, match="no measured channel in common"):
        compare_runs(robot, runs[0], commands)
