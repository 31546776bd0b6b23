"""The record of a playback: the device's samples on the device's time, in little memory."""

import tracemalloc

import numpy as np
import pytest

from rotemina.app.motion import recorder as recorder_module
from rotemina.app.motion.recorder import PlaybackRecorder
from rotemina.drivers.samples import Samples
from rotemina.sim.records.record import Record, RecordError, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory

ROBOT = load_robot("rotemina")
FIRST_S = 1234.5


def recorder_of(rows, axes=("thx",)):
    signals = {(axis, Tap.CMD): np.full(rows, sum(ROBOT.axes[axis].range) / 2) for axis in axes}
    units = {axis: ROBOT.axes[axis].unit for axis in axes}
    asked = Record.from_signals(np.arange(rows) / 500.0, signals, units)
    return PlaybackRecorder(CheckedTrajectory.sealed(ROBOT, asked, 1e-3), "board")


def samples(time_s, row, seed=0):
    rng = np.random.default_rng(seed)
    command, measured, inputs = rng.random((3, len(time_s), 6))
    return Samples(np.asarray(time_s), command, measured, inputs, np.asarray(row))


def test_times_are_the_devices_not_the_trajectorys():
    """A device whose clock runs 1 % fast, with a sample that comes late."""
    recorder = recorder_of(3)
    time_s = FIRST_S + np.array([-0.5, 0.0, 0.00101, 0.0025, 0.00303, 0.00404, 0.00505])
    given = samples(time_s, [-1, 0, -1, 1, -1, 2, -1])
    recorder.add(given)
    record = recorder.finish()
    assert recorder.complete
    np.testing.assert_array_equal(record.time_s, [0.0, 0.00101, 0.0025, 0.00303, 0.00404])
    np.testing.assert_array_equal(record.signal("thx", Tap.CMD), given.command[1:6, 3])
    np.testing.assert_array_equal(record.signal("thx", Tap.U), given.inputs[1:6, 3])
    np.testing.assert_array_equal(record.signal("thx", Tap.MEAS), given.measured[1:6, 3])


def test_even_sampling_stays_even_however_late_the_device():
    recorder = recorder_of(3)
    recorder.add(samples(FIRST_S + np.arange(5001) / 1000.0, [0, *[-1] * 4999, 2]))
    np.testing.assert_array_equal(recorder.finish().time_s, np.arange(5001) / 1000.0)


def test_what_is_cut_off_ends_with_the_last_row_that_began():
    recorder = recorder_of(9)
    for k in range(4):
        recorder.add(samples([k + 0.1, k + 0.5], [k, -1] if k < 3 else [-1, -1]))
    record = recorder.finish()
    assert not recorder.complete
    np.testing.assert_allclose(record.time_s, [0.0, 0.4, 1.0, 1.4, 2.0])


def test_nothing_played_is_no_record():
    recorder = recorder_of(3)
    recorder.add(samples([0.1, 0.2], [-1, -1]))
    assert recorder.finish() is None
    assert not recorder.complete


@pytest.mark.parametrize("row", [[0, 2, 1], [0, 1, 1], [0, 3, -1]])
def test_rows_out_of_order_make_no_record(row):
    recorder = recorder_of(3)
    with pytest.raises(RecordError, match="row"):
        recorder.add(samples([0.1, 0.2, 0.3], row))


def test_a_voltage_that_the_device_does_not_tell_is_left_out():
    recorder = recorder_of(2, axes=("x", "thx"))
    given = samples([0.1, 0.2], [0, 1])
    inputs = given.inputs.copy()
    inputs[1, 3] = np.nan
    recorder.add(Samples(given.device_time_s, given.command, given.measured, inputs, [0, 1]))
    columns = [str(column) for column in recorder.finish().columns]
    assert columns == ["x.cmd", "x.meas", "thx.cmd", "thx.meas"]


def test_a_long_playback_is_kept_once_and_let_go_of(monkeypatch):
    """Blocks are given back while the record is filled: at the end only the record is left."""
    monkeypatch.setattr(recorder_module, "_BLOCK_BYTES", 1 << 19)
    rows, reads = 100_000, 1000
    recorder = recorder_of(rows, axes=tuple(ROBOT.axes))
    tracemalloc.start()
    try:
        for begin in range(0, rows, reads):
            row = np.arange(begin, begin + reads)
            recorder.add(samples(row / 1000.0, row))
        record = recorder.finish()
        held, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    size = record.values.nbytes + record.time_s.nbytes
    assert size == rows * 16 * 8
    assert held < 1.05 * size
    assert peak < 2.6 * size
