"""Trajectories of taught points: where they go, how fast, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.plugins.trajectory import taught_trajectory
from rotemina.plugins.trajectory.taught_trajectory import RATE_HZ, TaughtPoint, taught
from rotemina.sim.excitation.quantity import ExcitationError
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.dry_run import dry_run

ROBOT = load_robot("rotemina")
MIDDLE = {axis: 0.5 * sum(one.range) for axis, one in ROBOT.axes.items()}


def point(speed=1.0, pause_s=0.0, **places):
    return TaughtPoint({**MIDDLE, **places}, speed, pause_s)


def test_it_goes_through_the_points_rests_at_each_and_the_dry_run_allows_it():
    far = {"x": 0.04, "thx": 2e-4, "zn": 50e-6}
    points = point(), point(pause_s=0.25, **far), point(speed=0.5, z=0.03)
    record = taught(ROBOT, points, "three points")
    table = np.column_stack([record.signal(axis, Tap.CMD) for axis in ROBOT.axes])
    assert table[0] == pytest.approx(list(MIDDLE.values()))
    assert table[-1] == pytest.approx(list(points[2].place.values()))
    there = (table == list(points[1].place.values())).all(axis=1)
    assert there.sum() == 0.25 * RATE_HZ + 1
    run = dry_run(ROBOT, record)
    assert run.allowed, run.objections
    # The slowest axis of the first way goes at its greatest speed or acceleration.
    figures = run.axes["x"]
    shares = (
        figures.peak_speed / ROBOT.axes["x"].max_speed,
        2.0 * figures.peak_acceleration / ROBOT.axes["x"].max_acceleration,
    )
    assert max(shares) == pytest.approx(1.0, abs=0.02)


def test_a_slower_way_takes_longer_where_speed_is_what_binds():
    lengths = [
        taught(ROBOT, [point(x=0.005), point(speed, x=0.05)], "").duration_s
        for speed in (0.5, 0.25)
    ]
    assert lengths[1] == pytest.approx(2.0 * lengths[0], rel=0.01)


@pytest.mark.parametrize(
    ("points", "error", "why"),
    [
        ([point()], ExcitationError, "1 points: a trajectory needs two"),
        ([point(), point(speed=0.0)], ExcitationError, "point 2: the speed of 0 % must be above 0"),
        ([point(), point(speed=1.01)], ExcitationError, "at most 100"),
        (
            [point(), point(pause_s=-1.0)],
            ExcitationError,
            "point 2: the pause of -1 s must be 0 to",
        ),
        ([point(), point(pause_s=float("nan"))], ExcitationError, "the pause of nan"),
        ([point(), point(x=0.056)], OutOfLimitsError, "56 mm is outside its range"),
    ],
)
def test_what_is_none_is_refused_with_the_bound(points, error, why):
    with pytest.raises(error, match=why):
        taught(ROBOT, points, "")


def test_too_many_rows_are_refused_before_they_are_made(monkeypatch):
    monkeypatch.setattr(taught_trajectory, "MOST_ROWS", 2000)
    with pytest.raises(ExcitationError, match="shorten pauses or increase speeds"):
        taught(ROBOT, [point(), replace(point(x=0.03), pause_s=1.9)], "")
