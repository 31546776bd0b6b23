"""Record of a playback: samples and time of the device, with little memory."""

import tracemalloc

import numpy as np
import pytest

from rotemina.app.motion.state import PlaybackRecorder, recorder as recorder_module
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.errors import RecordError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import CheckedTrajectory

ROBOT = load_robot("rotemina")
FIRST_S = 1234.5


def make_recorder(rows, axes=("thx",)):
    signals = {(axis, Tap.CMD): np.full(rows, sum(ROBOT.axes[axis].range) / 2) for axis in axes}
    units = {axis: ROBOT.axes[axis].unit for axis in axes}
    trajectory = Record.from_signals(np.arange(rows) / 500.0, signals, units)
    return PlaybackRecorder(CheckedTrajectory.seal(ROBOT, trajectory, 1e-3), "board")


def make_samples(time_s, row, seed=0):
    rng = np.random.default_rng(seed)
    command, measured, inputs = rng.random((3, len(time_s), 6))
    return DeviceSamples(np.asarray(time_s), command, measured, inputs, np.asarray(row))


def test_times_are_those_of_the_device_not_of_the_trajectory():
    """The clock of the device runs 1 % fast, and one sample is late."""
    recorder = make_recorder(3)
    time_s = FIRST_S + np.array([-0.5, 0.0, 0.00101, 0.0025, 0.00303, 0.00404, 0.00505])
    samples = make_samples(time_s, [-1, 0, -1, 1, -1, 2, -1])
    recorder.add(samples)
    record = recorder.finish()
    assert recorder.is_complete
    np.testing.assert_array_equal(record.time_s, [0.0, 0.00101, 0.0025, 0.00303, 0.00404])
    np.testing.assert_array_equal(record.signal("thx", Tap.CMD), samples.command[1:6, 3])
    np.testing.assert_array_equal(record.signal("thx", Tap.U), samples.inputs[1:6, 3])
    np.testing.assert_array_equal(record.signal("thx", Tap.MEAS), samples.measured[1:6, 3])


def test_even_sampling_stays_even_for_a_late_device():
    recorder = make_recorder(3)
    recorder.add(make_samples(FIRST_S + np.arange(5001) / 1000.0, [0, *[-1] * 4999, 2]))
    np.testing.assert_array_equal(recorder.finish().time_s, np.arange(5001) / 1000.0)


def test_an_interrupted_record_ends_with_the_last_row_that_began():
    recorder = make_recorder(9)
    recorder.add(make_samples([-0.2, -0.1], [-1, -1]))
    assert recorder.finish() is None
    for k in range(4):
        recorder.add(make_samples([k + 0.1, k + 0.5], [k, -1] if k < 3 else [-1, -1]))
    record = recorder.finish()
    assert not recorder.is_complete
    np.testing.assert_allclose(record.time_s, [0.0, 0.4, 1.0, 1.4, 2.0])


@pytest.mark.parametrize("row", [[0, 2, 1], [0, 1, 1], [0, 3, -1]])
def test_rows_out_of_order_make_no_record(row):
    recorder = make_recorder(3)
    with pytest.raises(RecordError, match="row"):
        recorder.add(make_samples([0.1, 0.2, 0.3], row))


def test_a_voltage_that_the_device_does_not_report_is_omitted():
    recorder = make_recorder(2, axes=("x", "thx"))
    samples = make_samples([0.1, 0.2], [0, 1])
    inputs = samples.inputs.copy()
    inputs[1, 3] = np.nan
    recorder.add(
        DeviceSamples(samples.device_time_s, samples.command, samples.measured, inputs, [0, 1])
    )
    columns = [str(column) for column in recorder.finish().columns]
    assert columns == ["x.cmd", "x.meas", "thx.cmd", "thx.meas"]


def test_a_long_playback_is_stored_only_once(monkeypatch):
    """Blocks are freed while the record is filled, so that only the record remains."""
    monkeypatch.setattr(recorder_module, "_BLOCK_BYTES", 1 << 19)
    rows, reads = 100_000, 1000
    recorder = make_recorder(rows, axes=tuple(ROBOT.axes))
    tracemalloc.start()
    try:
        for begin in range(0, rows, reads):
            row = np.arange(begin, begin + reads)
            recorder.add(make_samples(row / 1000.0, row))
        record = recorder.finish()
        current, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    size = record.values.nbytes + record.time_s.nbytes
    assert size == rows * 16 * 8
    assert current < 1.05 * size
    assert peak < 2.6 * size
