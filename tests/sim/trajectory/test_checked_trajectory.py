"""A checked trajectory is accepted where it was checked, and checked again elsewhere."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.checked_trajectory import accepted, check
from rotemina.sim.trajectory.trajectory_excesses import TrajectoryError

ROBOT = load_robot("rotemina")
EMPS = load_robot("emps")


def slide(speed=0.008, axis="x", rate_hz=1000.0, start=0.01):
    time_s = np.arange(501) / rate_hz
    command = start + speed * (time_s - np.sin(2 * np.pi * 2 * time_s) / (2 * np.pi * 2)) / 2
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: "m"})


def test_what_was_checked_for_the_robot_is_not_checked_again():
    checked = check(ROBOT, slide(), 1e-3)
    assert accepted(ROBOT, checked, 1e-3) is checked
    assert accepted(load_robot("rotemina"), checked, 2e-3) is checked


def test_a_record_is_checked():
    assert accepted(ROBOT, slide(), 1e-3).digest == check(ROBOT, slide(), 1e-3).digest
    with pytest.raises(OutOfLimitsError, match="speed"):
        accepted(ROBOT, slide(0.03), 1e-3)


def test_a_stricter_device_checks_again():
    with pytest.raises(OutOfLimitsError, match="2500 Hz"):
        accepted(ROBOT, check(ROBOT, slide(), 1e-3), 4e-4)


@pytest.mark.parametrize("period_s", [5e-4, 2e-3])
def test_a_loop_that_is_closed_at_another_rate_is_another_machine(period_s):
    checked = check(EMPS, slide(axis="q"), 1e-3)
    assert accepted(EMPS, checked, period_s) is not checked


def test_a_trajectory_checked_for_another_robot_is_refused():
    narrow = replace(ROBOT, axes={**ROBOT.axes, "x": replace(ROBOT.axes["x"], range=(0.0, 0.01))})
    with pytest.raises(TrajectoryError, match="checked for robot 'RoTeMiNa'"):
        accepted(narrow, check(ROBOT, slide(), 1e-3), 1e-3)


def test_the_digest_tells_trajectories_apart():
    first, same, later = (check(ROBOT, slide(speed), 1e-3) for speed in (0.008, 0.008, 0.007))
    assert first.digest == same.digest != later.digest
