"""Stuck sensors are distinguished from axes at rest."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake import check_records
from rotemina.sim.records import Tap

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from intake_records import ROBOT, get_refusal, modify_record, simulate_record


def test_a_stuck_sensor_is_refused():
    record = simulate_record()
    stuck_record = modify_record(record, {("thx", Tap.MEAS): np.full(4000, 3e-4)})
    message = get_refusal(stuck_record, names=["dead.csv"])
    assert message.startswith(
        "dead.csv: thx.meas stays at exactly 300 µrad for 100 % of the rows, while the axis is "
        "commanded to move (first at t = 0 s): the sensor is stuck or not connected"
    )


def test_a_saturated_sensor_is_refused_if_certain_and_otherwise_reported():
    record = simulate_record()
    # The first axis has a fluctuating reading, the second one has a reference.
    for axis in ("thx", "x"):
        reading = record.signal(axis, Tap.MEAS)
        clipped = np.minimum(reading, np.percentile(reading, 85.0))
        saturated_record = modify_record(record, {(axis, Tap.MEAS): clipped})
        assert f"{axis}.meas stays at exactly " in get_refusal(saturated_record)
        assert "the sensor is saturated; repair it, stay within its measuring range" in get_refusal(
            saturated_record
        )
    without_reference = modify_record(saturated_record, {("x", Tap.REF): None})
    assert [
        str(caution.text)[:29]
        for caution in check_records(ROBOT, [without_reference])
        if caution.record == 0
    ] == ["The reading stays at exactly "]


def test_an_axis_that_really_stops_is_not_a_fault():
    """At a hard stop the noise is below the step of the encoder, but the reference rests too."""
    record = simulate_record()
    stop = np.round(np.percentile(record.signal("x", Tap.MEAS), 80.0), 7)
    stopped_signals = {
        ("x", tap): np.minimum(record.signal("x", tap), stop) for tap in (Tap.REF, Tap.MEAS)
    }
    assert check_records(ROBOT, [modify_record(record, stopped_signals)]) == ()


def hold_signal(signal, begin, end):
    signal = signal.copy()
    signal[begin:end] = signal[begin]
    return signal


def test_dropouts_pass_and_a_long_one_is_refused():
    record = simulate_record()
    reading = record.signal("thx", Tap.MEAS)
    short_holds, short_zeros = reading.copy(), reading.copy()
    for begin in range(300, 3300, 500):
        short_holds = hold_signal(short_holds, begin, begin + 100)
        short_zeros[begin : begin + 100] = 0.0
    for modified in (short_holds, short_zeros):
        assert check_records(ROBOT, [modify_record(record, {("thx", Tap.MEAS): modified})]) == ()
    long_hold = modify_record(record, {("thx", Tap.MEAS): hold_signal(reading, 1000, 2000)})
    assert "the sensor is stuck or not connected" in get_refusal(long_hold)
