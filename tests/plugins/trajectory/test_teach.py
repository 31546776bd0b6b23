"""Trajectories through taught points: positions, speeds and refusals."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.plugins.trajectory import taught_trajectory
from rotemina.plugins.trajectory.taught_trajectory import (
    RATE_HZ,
    TaughtPoint,
    make_taught_trajectory,
)
from rotemina.sim.errors import ExcitationRequestError, OutOfLimitsError
from rotemina.sim.records import Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

ROBOT = load_robot("rotemina")
MIDDLE = {name: 0.5 * sum(axis.range) for name, axis in ROBOT.axes.items()}


def make_point(speed=1.0, pause_s=0.0, **positions):
    return TaughtPoint({**MIDDLE, **positions}, speed, pause_s)


def test_a_taught_trajectory_passes_and_rests_at_its_points_and_is_allowed():
    far = {"x": 0.04, "thx": 2e-4, "zn": 50e-6}
    points = make_point(), make_point(pause_s=0.25, **far), make_point(speed=0.5, z=0.03)
    record = make_taught_trajectory(ROBOT, points, "three points")
    table = np.column_stack([record.signal(axis, Tap.CMD) for axis in ROBOT.axes])
    assert table[0] == pytest.approx(list(MIDDLE.values()))
    assert table[-1] == pytest.approx(list(points[2].place.values()))
    is_at_second_point = (table == list(points[1].place.values())).all(axis=1)
    assert is_at_second_point.sum() == 0.25 * RATE_HZ + 1
    run = dry_run(ROBOT, record)
    assert run.allowed, run.objections
    # On the first section, the slowest axis uses its full speed or acceleration.
    figures = run.axes["x"]
    shares = (
        figures.peak_speed / ROBOT.axes["x"].max_speed,
        2.0 * figures.peak_acceleration / ROBOT.axes["x"].max_acceleration,
    )
    assert max(shares) == pytest.approx(1.0, abs=0.02)


def test_half_the_speed_doubles_the_duration_of_a_long_move():
    durations_s = [
        make_taught_trajectory(
            ROBOT, [make_point(x=0.005), make_point(speed, x=0.05)], ""
        ).duration_s
        for speed in (0.5, 0.25)
    ]
    assert durations_s[1] == pytest.approx(2.0 * durations_s[0], rel=0.01)


@pytest.mark.parametrize(
    ("points", "error", "message"),
    [
        ([make_point()], ExcitationRequestError, "1 points: a trajectory needs two"),
        (
            [make_point(), make_point(speed=0.0)],
            ExcitationRequestError,
            "point 2: the speed of 0 % must be above 0",
        ),
        ([make_point(), make_point(speed=1.01)], ExcitationRequestError, "at most 100"),
        (
            [make_point(), make_point(pause_s=-1.0)],
            ExcitationRequestError,
            "point 2: the pause of -1 s must be 0 to",
        ),
        (
            [make_point(), make_point(pause_s=float("nan"))],
            ExcitationRequestError,
            "the pause of nan",
        ),
        ([make_point(), make_point(x=0.056)], OutOfLimitsError, "56 mm is outside its range"),
    ],
)
def test_invalid_points_are_refused_with_the_bound(points, error, message):
    with pytest.raises(error, match=message):
        make_taught_trajectory(ROBOT, points, "")


def test_a_too_long_trajectory_is_refused(monkeypatch):
    monkeypatch.setattr(taught_trajectory, "MAX_ROWS", 2000)
    with pytest.raises(ExcitationRequestError, match="shorten pauses or increase speeds"):
        make_taught_trajectory(ROBOT, [make_point(), replace(make_point(x=0.03), pause_s=1.9)], "")
