"""Retiming of a trajectory: its pace, and its remainder from a row on."""

import numpy as np
import pytest

from rotemina.app.motion.playback.retiming import EASE_IN_S, retime
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory.checked_trajectory import check_and_seal

ROBOT = load_robot("rotemina")
PERIOD_S = 5e-3


def make_swing(rows=801, period_s=PERIOD_S):
    time_s = 3.0 + np.arange(rows) * period_s
    window = np.sin(np.pi * np.linspace(0.0, 1.0, rows)) ** 2
    x = 0.02 + 2e-3 * window * np.sin(2.0 * np.pi * 0.5 * time_s)
    return Record.from_signals(time_s, {("x", Tap.CMD): x}, {"x": "m"}, {"name": "swing"})


@pytest.mark.parametrize("speed", [0.25, 2.0])
def test_a_pace_changes_only_the_times(speed):
    retimed = retime(make_swing(), speed=speed, setpoint_period_s=PERIOD_S)
    np.testing.assert_array_equal(retimed.trajectory.values, make_swing().values)
    assert retimed.trajectory.duration_s == pytest.approx(
        make_swing().duration_s / speed, rel=1e-12
    )
    assert retimed.find_path_time(retimed.trajectory.duration_s / 2) == pytest.approx(2.0, abs=1e-9)
    assert dict(retimed.trajectory.metadata) == {"name": "swing"}


@pytest.mark.parametrize("row", [1, 437, 800])
def test_a_remainder_begins_at_rest_and_ends_like_the_whole(row):
    whole = make_swing()
    rest = retime(whole, row=row, setpoint_period_s=PERIOD_S)
    check_and_seal(ROBOT, rest.trajectory, PERIOD_S)  # speed and acceleration from rest
    x = rest.trajectory.signal("x", Tap.CMD)
    assert x[0] == whole.signal("x", Tap.CMD)[row]
    assert x[-1] == whole.signal("x", Tap.CMD)[-1]
    on_path = np.interp(rest.path_s, whole.time_s - whole.time_s[0], whole.signal("x", Tap.CMD))
    np.testing.assert_allclose(x, on_path, rtol=0.0, atol=1e-12)
    assert (np.diff(rest.path_s) >= 0.0).all()
    assert rest.path_s[0] == pytest.approx(row * PERIOD_S)


def test_without_easing_the_limits_refuse_a_remainder():
    middle = make_swing().select_rows(slice(400, None))
    with pytest.raises(InputError, match="acceleration"):
        check_and_seal(ROBOT, middle, PERIOD_S)


def test_the_pace_rises_linearly_to_full():
    rest = retime(make_swing(), row=100, setpoint_period_s=PERIOD_S)
    pace = np.diff(rest.path_s) / np.diff(rest.trajectory.time_s)
    is_rising = rest.trajectory.time_s[1:] < EASE_IN_S
    np.testing.assert_allclose(np.diff(pace[is_rising]), PERIOD_S / EASE_IN_S, atol=1e-9)
    np.testing.assert_allclose(pace[~is_rising][1:-2], 1.0, atol=1e-9)


def test_sparse_rows_are_kept():
    time_s = np.array([0.0, 1.0, 2.5, 4.0])
    positions = Record.from_signals(
        time_s, {("x", Tap.CMD): np.array([0.02, 0.021, 0.022, 0.02])}, {"x": "m"}
    )
    rest = retime(positions, row=2, speed=0.5, setpoint_period_s=PERIOD_S)
    np.testing.assert_array_equal(rest.trajectory.time_s, [0.0, 3.0])
    np.testing.assert_array_equal(rest.trajectory.signal("x", Tap.CMD), [0.022, 0.02])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"speed": 0.0}, "speed 0 must"),
        ({"speed": float("nan")}, "0.01 to 10"),
        ({"speed": 11.0}, "0.01 to 10"),
        ({"row": 801}, "rows 0 to 800"),
        ({"row": -1}, "row -1"),
    ],
)
def test_an_invalid_pace_or_row_is_refused(options, message):
    with pytest.raises(InputError, match=message):
        retime(make_swing(), setpoint_period_s=PERIOD_S, **options)
