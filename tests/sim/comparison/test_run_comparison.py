"""Two runs of a machine: how far their tips are apart, and what cannot be compared."""

import numpy as np
import pytest

from rotemina.sim.comparison.run_comparison import compare_runs
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot


def test_the_path_error_of_two_runs_is_the_distance_of_their_tips():
    robot = load_robot("rotemina")
    time_s = np.arange(101) / 100.0
    rest = {axis: 0.5 * sum(one.range) for axis, one in robot.axes.items()}
    rest["x"] = rest["x"] + 1e-4 * time_s
    runs = [
        Record.from_signals(
            time_s,
            {
                (axis, tap): np.broadcast_to(at, 101) + (apart if axis in "xy" else 0.0)
                for axis, at in rest.items()
                for tap in (Tap.CMD, Tap.MEAS)
            },
            {axis: robot.unit(axis) for axis in robot.axes},
        )
        for apart in (0.0, 3e-6)
    ]
    found = compare_runs(robot, *runs)
    assert found.path_rms == pytest.approx(2**0.5 * 3e-6)
    assert found.path_peak == pytest.approx(2**0.5 * 3e-6)
    commands = Record.from_signals(time_s, {("x", Tap.CMD): time_s}, {"x": "m"})
    with pytest.raises(InputError, match="no measured channel in common"):
        compare_runs(robot, runs[0], commands)
