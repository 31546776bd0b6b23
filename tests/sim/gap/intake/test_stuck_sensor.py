"""Sensors that stand still, told from axes that do."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.records.record import Tap

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from intake_records import ROBOT, changed, measured, refusal


def test_a_sensor_that_does_not_answer_is_refused():
    record = measured()
    dead = changed(record, {("thx", Tap.MEAS): np.full(4000, 3e-4)})
    said = refusal(dead, names=["dead.csv"])
    assert said.startswith(
        "dead.csv: thx.meas stands at exactly 300 µrad for 100 % of the rows, while the axis is "
        "commanded to move (first at t = 0 s): the sensor is stuck or not connected"
    )


def test_a_saturated_sensor_is_refused_where_it_is_sure_and_else_told():
    record = measured()
    for axis in ("thx", "x"):  # the noise of the one flickers, the other has a reference
        reading = record.signal(axis, Tap.MEAS)
        clipped = np.minimum(reading, np.percentile(reading, 85.0))
        bad = changed(record, {(axis, Tap.MEAS): clipped})
        assert f"{axis}.meas stands at exactly " in refusal(bad)
        assert "the sensor is saturated; repair it, stay within what it can read" in refusal(bad)
    alone = changed(bad, {("x", Tap.REF): None})
    assert [str(one.text)[:29] for one in check(ROBOT, [alone]) if one.record == 0] == [
        "The reading stays at exactly "
    ]


def test_an_axis_that_truly_stops_is_no_fault():
    """A hard stop: the encoder's noise is below its step, but the reference stands as well."""
    record = measured()
    stop = np.round(np.percentile(record.signal("x", Tap.MEAS), 80.0), 7)
    ends = {("x", tap): np.minimum(record.signal("x", tap), stop) for tap in (Tap.REF, Tap.MEAS)}
    assert check(ROBOT, [changed(record, ends)]) == ()


def held(signal, begin, end):
    signal = signal.copy()
    signal[begin:end] = signal[begin]
    return signal


def test_dropouts_pass_and_a_long_one_is_refused():
    record = measured()
    reading = record.signal("thx", Tap.MEAS)
    short, gone = reading.copy(), reading.copy()
    for begin in range(300, 3300, 500):
        short = held(short, begin, begin + 100)
        gone[begin : begin + 100] = 0.0
    for taken in (short, gone):
        assert check(ROBOT, [changed(record, {("thx", Tap.MEAS): taken})]) == ()
    long = changed(record, {("thx", Tap.MEAS): held(reading, 1000, 2000)})
    assert "the sensor is stuck or not connected" in refusal(long)
