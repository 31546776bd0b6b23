"""When set-points of a trajectory are applied."""

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.trajectory.schedule import Schedule


def schedule(time_s, command=None, **options):
    time_s = np.asarray(time_s, dtype=float)
    command = np.arange(len(time_s)) * 1.0 if command is None else np.asarray(command)
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    return Schedule(record, ("x",), 0.1, **options)


def test_rows_are_instants_and_distant_ones_have_ticks_between():
    instants = schedule([5.0, 5.05, 5.3], on_ticks=False).instants(0, 99)
    np.testing.assert_allclose(instants.time_s, [0.0, 0.05, 0.05 + 0.25 / 3, 0.05 + 0.5 / 3, 0.3])
    assert instants.row.tolist() == [0, 1, 1, 1, 2]
    assert instants.on_row.tolist() == [True, True, False, False, True]


def test_on_ticks_a_row_begins_at_the_first_tick_that_is_not_before_it():
    instants = schedule([5.0, 5.05, 5.07, 5.3, 5.31], on_ticks=True).instants(0, 99)
    np.testing.assert_allclose(instants.time_s, [0.0, 0.1, 0.2, 0.3, 0.4])
    assert instants.row.tolist() == [0, 2, 2, 3, 4]
    assert instants.on_row.tolist() == [True, True, False, True, True]


def test_pieces_are_the_whole():
    whole = schedule(np.cumsum(np.linspace(0.01, 0.4, 30)), on_ticks=True)
    pieces = [whole.instants(k, k + 7) for k in range(0, whole.count, 7)]
    for name in ("time_s", "row", "on_row"):
        joined = np.concatenate([getattr(piece, name) for piece in pieces])
        np.testing.assert_array_equal(joined, getattr(whole.instants(0, whole.count), name))


@pytest.mark.parametrize("on_ticks", [True, False])
def test_instants_up_to_a_time_are_counted_without_making_them(on_ticks):
    whole = schedule(np.cumsum(np.linspace(0.01, 0.4, 30)), on_ticks=on_ticks)
    instants = whole.instants(0, whole.count).time_s
    between = np.random.default_rng(0).uniform(-0.5, instants[-1] + 1.0, 500)
    for time_s in between:
        assert whole.count_until(time_s) == np.searchsorted(instants, time_s, side="right")
    for time_s in instants:  # where rounding decides
        assert abs(whole.count_until(time_s) - np.searchsorted(instants, time_s, "right")) <= 1


@pytest.mark.parametrize("on_ticks", [True, False])
@pytest.mark.parametrize(
    ("time_s", "instant", "speed"),
    [
        ([0.0, 0.1, 0.2, 0.3], 2, 10.0),
        ([0.0, 0.1, 0.2, 0.3], 0, 0.0),
        ([0.0, 0.1, 1.0], 3, 0.0),  # held for two ticks since
        ([0.0, 0.5, 1.0], 5, 0.0),  # come by a jump
    ],
)
def test_commands_have_a_speed_only_where_rows_follow_tick_by_tick(
    time_s, instant, speed, on_ticks
):
    velocity = schedule(time_s, on_ticks=on_ticks).velocity(instant, 1)
    assert velocity == pytest.approx([speed])


def test_the_speed_of_dense_rows_is_taken_over_a_tick_and_not_over_their_rounding():
    time_s = np.arange(101) * 0.01
    velocity = schedule(time_s, np.round(time_s, 1), on_ticks=False).velocity(100, 1)
    assert velocity == pytest.approx([1.0], rel=0.4)
