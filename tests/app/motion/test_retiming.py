"""Pace and pieces of a trajectory."""

import numpy as np
import pytest

from rotemina.app.motion.retiming import EASING_S, piece
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.checked_trajectory import check

ROBOT = load_robot("rotemina")
PERIOD_S = 5e-3


def swing(rows=801, period_s=PERIOD_S):
    time_s = 3.0 + np.arange(rows) * period_s
    window = np.sin(np.pi * np.linspace(0.0, 1.0, rows)) ** 2
    x = 0.02 + 2e-3 * window * np.sin(2.0 * np.pi * 0.5 * time_s)
    return Record.from_signals(time_s, {("x", Tap.CMD): x}, {"x": "m"}, {"name": "swing"})


@pytest.mark.parametrize("speed", [0.25, 1.0, 2.0])
def test_a_pace_changes_times_and_nothing_else(speed):
    played = piece(swing(), speed=speed, setpoint_period_s=PERIOD_S)
    np.testing.assert_array_equal(played.trajectory.values, swing().values)
    assert played.trajectory.duration_s == pytest.approx(swing().duration_s / speed, rel=1e-12)
    assert played.path_time(played.trajectory.duration_s / 2) == pytest.approx(2.0, abs=1e-9)
    assert dict(played.trajectory.metadata) == {"name": "swing"}


@pytest.mark.parametrize("row", [1, 200, 437, 799, 800])
def test_what_goes_on_in_the_middle_begins_at_rest_and_ends_where_the_whole_ends(row):
    whole = swing()
    rest = piece(whole, row=row, setpoint_period_s=PERIOD_S)
    check(ROBOT, rest.trajectory, PERIOD_S)  # speed and acceleration, from rest
    x = rest.trajectory.signal("x", Tap.CMD)
    assert x[0] == whole.signal("x", Tap.CMD)[row]
    assert x[-1] == whole.signal("x", Tap.CMD)[-1]
    on_path = np.interp(rest.path_s, whole.time_s - whole.time_s[0], whole.signal("x", Tap.CMD))
    np.testing.assert_allclose(x, on_path, rtol=0.0, atol=1e-12)
    assert (np.diff(rest.path_s) >= 0.0).all()
    assert rest.path_s[0] == pytest.approx(row * PERIOD_S)


def test_without_easing_the_limits_would_refuse_it():
    middle = swing().part(slice(400, None))
    with pytest.raises(InputError, match="acceleration"):
        check(ROBOT, middle, PERIOD_S)


def test_the_pace_rises_evenly_to_full():
    rest = piece(swing(), row=100, setpoint_period_s=PERIOD_S)
    pace = np.diff(rest.path_s) / np.diff(rest.trajectory.time_s)
    rising = rest.trajectory.time_s[1:] < EASING_S
    np.testing.assert_allclose(np.diff(pace[rising]), PERIOD_S / EASING_S, atol=1e-9)
    np.testing.assert_allclose(pace[~rising][1:-2], 1.0, atol=1e-9)


def test_rows_far_apart_stay_places():
    time_s = np.array([0.0, 1.0, 2.5, 4.0])
    places = Record.from_signals(
        time_s, {("x", Tap.CMD): np.array([0.02, 0.021, 0.022, 0.02])}, {"x": "m"}
    )
    rest = piece(places, row=2, speed=0.5, setpoint_period_s=PERIOD_S)
    np.testing.assert_array_equal(rest.trajectory.time_s, [0.0, 3.0])
    np.testing.assert_array_equal(rest.trajectory.signal("x", Tap.CMD), [0.022, 0.02])


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"speed": 0.0}, "speed 0 must"),
        ({"speed": float("nan")}, "0.01 to 10"),
        ({"speed": 11.0}, "0.01 to 10"),
        ({"row": 801}, "rows 0 to 800"),
        ({"row": -1}, "row -1"),
    ],
)
def test_what_is_no_pace_or_row_is_refused(options, words):
    with pytest.raises(InputError, match=words):
        piece(swing(), setpoint_period_s=PERIOD_S, **options)
