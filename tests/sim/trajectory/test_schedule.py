"""The instants at which set-points of a trajectory are applied."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.trajectory import PlaybackSchedule


def make_schedule(time_s, command=None, **options):
    time_s = np.asarray(time_s, dtype=float)
    command = np.arange(len(time_s)) * 1.0 if command is None else np.asarray(command)
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    return PlaybackSchedule(record, ("x",), 0.1, **options)


def test_rows_are_instants_and_distant_rows_have_ticks_between_them():
    instants = make_schedule([5.0, 5.05, 5.3], on_ticks=False).instants(0, 99)
    np.testing.assert_allclose(instants.time_s, [0.0, 0.05, 0.05 + 0.25 / 3, 0.05 + 0.5 / 3, 0.3])
    assert instants.row.tolist() == [0, 1, 1, 1, 2]
    assert instants.on_row.tolist() == [True, True, False, False, True]


def test_on_ticks_a_row_starts_at_the_next_tick():
    instants = make_schedule([5.0, 5.05, 5.07, 5.3, 5.31], on_ticks=True).instants(0, 99)
    np.testing.assert_allclose(instants.time_s, [0.0, 0.1, 0.2, 0.3, 0.4])
    assert instants.row.tolist() == [0, 2, 2, 3, 4]
    assert instants.on_row.tolist() == [True, True, False, True, True]


def test_instants_in_pieces_equal_the_whole():
    schedule = make_schedule(np.cumsum(np.linspace(0.01, 0.4, 30)), on_ticks=True)
    pieces = [schedule.instants(k, k + 7) for k in range(0, schedule.count, 7)]
    for name in ("time_s", "row", "on_row"):
        joined = np.concatenate([getattr(piece, name) for piece in pieces])
        np.testing.assert_array_equal(joined, getattr(schedule.instants(0, schedule.count), name))


@pytest.mark.parametrize("on_ticks", [True, False])
def test_instants_up_to_a_time_are_counted(on_ticks):
    schedule = make_schedule(np.cumsum(np.linspace(0.01, 0.4, 30)), on_ticks=on_ticks)
    instants = schedule.instants(0, schedule.count).time_s
    times_between = np.random.default_rng(0).uniform(-0.5, instants[-1] + 1.0, 500)
    for time_s in times_between:
        assert schedule.count_until(time_s) == np.searchsorted(instants, time_s, side="right")
    for time_s in instants:  # where rounding decides
        assert abs(schedule.count_until(time_s) - np.searchsorted(instants, time_s, "right")) <= 1


@pytest.mark.parametrize("on_ticks", [True, False])
@pytest.mark.parametrize(
    ("time_s", "instant", "speed"),
    [
        ([0.0, 0.1, 0.2, 0.3], 2, 10.0),
        ([0.0, 0.1, 0.2, 0.3], 0, 0.0),
        ([0.0, 0.1, 1.0], 3, 0.0),  # held for two ticks
        ([0.0, 0.5, 1.0], 5, 0.0),  # reached by a jump
    ],
)
def test_commands_have_a_speed_only_if_rows_follow_at_each_tick(time_s, instant, speed, on_ticks):
    velocity = make_schedule(time_s, on_ticks=on_ticks).velocity(instant, 1)
    assert velocity == pytest.approx([speed])


def test_the_speed_of_dense_rows_is_averaged_over_a_tick():
    time_s = np.arange(101) * 0.01
    velocity = make_schedule(time_s, np.round(time_s, 1), on_ticks=False).velocity(100, 1)
    assert velocity == pytest.approx([1.0], rel=0.4)
