"""Rows that are missing, and periods that do not repeat."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.records.record import Record

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from intake_records import ROBOT, changed, measured, refusal, timed


def test_single_missing_rows_and_scattered_times_are_told():
    record = measured()
    kept = np.delete(np.arange(4000), [500, 900, 1700])
    part = Record(record.time_s[kept], record.columns, record.values[kept], record.units)
    [caution] = check(ROBOT, [part])
    assert str(caution.text).startswith("Rows are missing at 3 places of a record")
    scatter = 3e-4 * np.random.default_rng(0).uniform(-1.0, 1.0, 4000)
    [caution] = check(ROBOT, [timed(record, record.time_s + scatter)])
    assert "their scatter appears as sensor noise" in str(caution.text)


def test_a_periodic_record_repeats_its_commands():
    record = measured(axes=("x",))
    wrong = changed(record, history="periodic", period_samples="1000")
    assert "x.cmd at row " in refusal(wrong)
    assert "is not what it was a period before" in refusal(wrong)
