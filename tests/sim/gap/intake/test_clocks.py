"""Missing rows, and periods that do not repeat."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake import check_records
from rotemina.sim.records import Record

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from intake_records import ROBOT, get_refusal, modify_record, replace_times, simulate_record


def test_single_missing_rows_and_scattered_times_are_reported():
    record = simulate_record()
    rows = np.delete(np.arange(4000), [500, 900, 1700])
    partial_record = Record(record.time_s[rows], record.columns, record.values[rows], record.units)
    [caution] = check_records(ROBOT, [partial_record])
    assert str(caution.text).startswith("Rows are missing at 3 places of a record")
    scatter = 3e-4 * np.random.default_rng(0).uniform(-1.0, 1.0, 4000)
    [caution] = check_records(ROBOT, [replace_times(record, record.time_s + scatter)])
    assert "their scatter appears as sensor noise" in str(caution.text)


def test_a_periodic_record_repeats_its_commands():
    record = simulate_record(axes=("x",))
    wrong = modify_record(record, history="periodic", period_samples="1000")
    assert "x.cmd at row " in get_refusal(wrong)
    assert "differs from its value one period earlier" in get_refusal(wrong)
