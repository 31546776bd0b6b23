"""A checked trajectory is accepted for its robot and period, and checked again for others."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import OutOfLimitsError, TrajectoryError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import accept_trajectory
from rotemina.sim.trajectory.checked_trajectory import check_and_seal

ROBOT = load_robot("rotemina")
EMPS = load_robot("emps")


def make_slide(speed=0.008, axis="x", rate_hz=1000.0, start=0.01):
    time_s = np.arange(501) / rate_hz
    command = start + speed * (time_s - np.sin(2 * np.pi * 2 * time_s) / (2 * np.pi * 2)) / 2
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: "m"})


def test_a_trajectory_that_was_checked_for_the_robot_is_not_checked_again():
    checked = check_and_seal(ROBOT, make_slide(), 1e-3)
    assert accept_trajectory(ROBOT, checked, 1e-3) is checked
    assert accept_trajectory(load_robot("rotemina"), checked, 2e-3) is checked


def test_an_unchecked_record_is_checked():
    assert (
        accept_trajectory(ROBOT, make_slide(), 1e-3).digest
        == check_and_seal(ROBOT, make_slide(), 1e-3).digest
    )
    with pytest.raises(OutOfLimitsError, match="speed"):
        accept_trajectory(ROBOT, make_slide(0.03), 1e-3)


def test_a_device_with_a_shorter_period_checks_again():
    with pytest.raises(OutOfLimitsError, match="2500 Hz"):
        accept_trajectory(ROBOT, check_and_seal(ROBOT, make_slide(), 1e-3), 4e-4)


@pytest.mark.parametrize("period_s", [5e-4, 2e-3])
def test_a_loop_with_another_rate_checks_again(period_s):
    checked = check_and_seal(EMPS, make_slide(axis="q"), 1e-3)
    assert accept_trajectory(EMPS, checked, period_s) is not checked


def test_a_trajectory_checked_for_another_robot_is_refused():
    narrow = replace(ROBOT, axes={**ROBOT.axes, "x": replace(ROBOT.axes["x"], range=(0.0, 0.01))})
    with pytest.raises(TrajectoryError, match="checked for robot 'RoTeMiNa'"):
        accept_trajectory(narrow, check_and_seal(ROBOT, make_slide(), 1e-3), 1e-3)


def test_the_digest_distinguishes_trajectories():
    first, repeated, other = (
        check_and_seal(ROBOT, make_slide(speed), 1e-3) for speed in (0.008, 0.008, 0.007)
    )
    assert first.digest == repeated.digest != other.digest
