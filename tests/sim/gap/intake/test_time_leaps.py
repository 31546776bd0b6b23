"""Records are split where the time jumps."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake import check_records, split_at_leaps
from rotemina.sim.records import Record, Tap
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from intake_records import ROBOT, get_refusal, modify_record, replace_times, simulate_record


def insert_time_jumps(record, jump_s, *rows):
    """Return the record with a jump of time before each of these rows."""
    later = sum(jump_s * (np.arange(len(record.time_s)) >= row) for row in rows)
    return replace_times(record, record.time_s + later)


def test_a_record_is_split_where_the_time_jumps():
    record = insert_time_jumps(modify_record(simulate_record(), name="a"), 1.5, 1000, 1050, 3950)
    [caution] = check_records(ROBOT, [record])
    assert (caution.axis, caution.record) == (None, 0)
    assert str(caution.text) == (
        "Time jumps 3 ×, by up to 1.5 s: the record is split there, and the history of "
        "each piece is unknown; 100 rows in pieces shorter than 100 are omitted."
    )
    first, second = split_at_leaps([record], ["a.csv"])
    assert (first.name, first.number) == ("a.csv, rows 1 to 1000", 0)
    assert (first.record.history, second.record.history) == ("rest", "unknown")
    assert second.record.metadata["name"] == "a"
    assert np.array_equal(second.record.values, record.values[1050:3950])


def test_pieces_of_a_periodic_record_have_an_unknown_history():
    record = modify_record(simulate_record(), history="periodic", period_samples="1000")
    halves = split_at_leaps([insert_time_jumps(record, 2.0, 2000)])
    assert [half.record.history for half in halves] == ["unknown", "unknown"]
    assert [half.record.period_samples for half in halves] == [None, None]


def test_short_jumps_split_a_record_only_while_an_axis_moves():
    record = simulate_record()
    [caution] = check_records(ROBOT, [insert_time_jumps(record, 0.25, 1000)])
    assert str(caution.text).startswith("Time jumps 1 ×, by up to 0.251 s: the record is split")
    at_rest = insert_time_jumps(record, 0.25, 3900)
    assert len(split_at_leaps([at_rest])) == 1
    [caution] = check_records(ROBOT, [at_rest])
    assert str(caution.text).startswith(
        "Rows are missing in a record for up to 0.251 s while no axis"
    )
    assert len(split_at_leaps([insert_time_jumps(record, 1.5, 3900)])) == 2


def test_slow_rows_are_not_jumps():
    slow_record = replace_times(
        simulate_record(axes=("zn",)), 1e4 * simulate_record(axes=("zn",)).time_s
    )
    assert len(split_at_leaps([slow_record])) == 1
    assert len(split_at_leaps([insert_time_jumps(slow_record, 95.0, 2000)])) == 2


def test_a_record_without_a_sufficiently_long_piece_is_refused():
    record = insert_time_jumps(simulate_record(rows=300), 2.0, 99, 198, 210)
    assert get_refusal(record, simulate_record(seed=1), names=["a.csv", "b.csv"]) == (
        "a.csv: time jumps 3 ×, by up to 2 s, and no piece between has more than 99 rows; a "
        "diagnosis needs 100 or more without a jump: leave the record out, or record without losses"
    )


def test_holds_may_be_written_sparsely():
    """Rows are omitted while all axes hold, up to the row at which one of them moves."""
    time_s = np.arange(4000) / 1000.0
    steps = 2e-5 + 1e-5 * (np.floor(time_s) % 2.0)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): steps}, {"zn": "m"})
    record = simulate(ROBOT, (), commands, np.random.default_rng(0))
    row_numbers = np.flatnonzero(time_s % 1.0 < 0.8)
    sparse = Record(
        record.time_s[row_numbers], record.columns, record.values[row_numbers], record.units
    )
    assert [str(caution.text)[:31] for caution in check_records(ROBOT, [sparse])] == [
        "Rows are missing in a record fo"
    ]
