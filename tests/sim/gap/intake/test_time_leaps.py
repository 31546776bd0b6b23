"""Records are split where time leaps."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.gap.intake.time_leaps import pieces
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.simulation.simulation import simulate

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from intake_records import ROBOT, changed, measured, refusal, timed


def with_leap(record, leap_s, *rows):
    """The record with time that leaps before each of these rows."""
    later = sum(leap_s * (np.arange(len(record.time_s)) >= row) for row in rows)
    return timed(record, record.time_s + later)


def test_a_record_is_split_where_time_leaps():
    record = with_leap(changed(measured(), name="a"), 1.5, 1000, 1050, 3950)
    [caution] = check(ROBOT, [record])
    assert (caution.axis, caution.record) == (None, 0)
    assert str(caution.text) == (
        "Time jumps 3 ×, by up to 1.5 s: the record is split there, and the history of "
        "each piece is unknown; 100 rows in pieces shorter than 100 are omitted."
    )
    first, second = pieces([record], ["a.csv"])
    assert (first.name, first.number) == ("a.csv, rows 1 to 1000", 0)
    assert (first.record.history, second.record.history) == ("rest", "unknown")
    assert second.record.metadata["name"] == "a"
    assert np.array_equal(second.record.values, record.values[1050:3950])


def test_what_came_before_a_piece_of_a_periodic_record_is_unknown():
    record = changed(measured(), history="periodic", period_samples="1000")
    halves = pieces([with_leap(record, 2.0, 2000)])
    assert [one.record.history for one in halves] == ["unknown", "unknown"]
    assert [one.record.period_samples for one in halves] == [None, None]


def test_short_leaps_split_where_an_axis_is_under_way():
    record = measured()
    [caution] = check(ROBOT, [with_leap(record, 0.25, 1000)])
    assert str(caution.text).startswith("Time jumps 1 ×, by up to 0.251 s: the record is split")
    at_rest = with_leap(record, 0.25, 3900)
    assert len(pieces([at_rest])) == 1
    [caution] = check(ROBOT, [at_rest])
    assert str(caution.text).startswith(
        "Rows are missing in a record for up to 0.251 s while no axis"
    )
    assert len(pieces([with_leap(record, 1.5, 3900)])) == 2


def test_slow_rows_are_no_leaps():
    slow = timed(measured(axes=("zn",)), 1e4 * measured(axes=("zn",)).time_s)
    assert len(pieces([slow])) == 1
    assert len(pieces([with_leap(slow, 95.0, 2000)])) == 2


def test_a_record_of_which_no_piece_is_long_enough_is_refused():
    record = with_leap(measured(rows=300), 2.0, 99, 198, 210)
    assert refusal(record, measured(seed=1), names=["a.csv", "b.csv"]) == (
        "a.csv: time jumps 3 ×, by up to 2 s, and no piece between has more than 99 rows; a "
        "diagnosis needs 100 or more without a jump: leave the record out, or record without losses"
    )


def test_holds_may_be_written_sparsely():
    """Rows are left out while all axes hold, up to the row at which one steps on."""
    time_s = np.arange(4000) / 1000.0
    steps = 2e-5 + 1e-5 * (np.floor(time_s) % 2.0)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): steps}, {"zn": "m"})
    record = simulate(ROBOT, (), commands, np.random.default_rng(0))
    kept = np.flatnonzero(time_s % 1.0 < 0.8)
    sparse = Record(record.time_s[kept], record.columns, record.values[kept], record.units)
    assert [str(one.text)[:31] for one in check(ROBOT, [sparse])] == [
        "Rows are missing in a record fo"
    ]
