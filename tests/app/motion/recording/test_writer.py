"""Recording writer: data read back, and bad disks affect neither motion nor recorded data."""

import errno
import threading
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording import Recording, is_being_recorded, recover_recording


def test_everything_reads_back_bit_by_bit(make_writer, feed, check, clock):
    writer = make_writer()
    writer.start_connection()
    writer.add_event("note", "µ: begin", {"a": [1, 2]})
    for number in range(5):
        feed(writer, 100 * number, 100)
        writer.add_row("camera", clock(), {"frame": number, "exposure_s": 0.1 * number})
        writer.run_once()
    recording = Recording.open(writer.close())
    check(recording.read_samples(), 0, 500)
    assert set(recording.read_samples().connection) == {1}
    assert recording.metadata["robot"] == "two axes"
    assert recording.units == {"x": "m", "thx": "rad"}
    assert [(event.kind, event.text, event.details) for event in recording.read_events()] == [
        ("note", "µ: begin", '{"a": [1, 2]}')
    ]
    assert recording.channels == ("camera", "clock")
    frames = recording.read_channel("camera")
    assert list(frames) == ["host_time_s", "frame", "exposure_s"]
    np.testing.assert_array_equal(frames["frame"], np.arange(5.0))
    np.testing.assert_allclose(frames["host_time_s"], 5.0 + 0.1 * np.arange(1, 6), rtol=1e-12)
    assert not writer.path.with_name("run.arrows.part").exists()


def test_a_channel_may_gain_and_omit_columns(make_writer):
    writer = make_writer()
    writer.add_row("stick", 1.0, {"x": 0.5})
    writer.run_once()
    writer.add_row("stick", 3.0, {"y": 2.0})
    writer.add_row("stick", 2.0, {"x": 0.25, "y": 1.0})
    stick = Recording.open(writer.close()).read_channel("stick")
    np.testing.assert_array_equal(stick["host_time_s"], [1.0, 2.0, 3.0])
    np.testing.assert_array_equal(stick["x"], [0.5, 0.25, np.nan])
    np.testing.assert_array_equal(stick["y"], [np.nan, 1.0, 2.0])


def test_host_times_follow_the_earliest_arrivals_and_never_go_back(
    make_writer, make_samples, clock
):
    """The device clock is off by 10 s, and samples arrive 1 to 9 ms late."""
    rng = np.random.default_rng(5)
    writer = make_writer()
    for first in range(0, 4000, 20):
        samples = make_samples(first, 20)
        delay_s = 1e-3 + 8e-3 * rng.random()
        writer.add(samples, samples.command, samples.device_time_s[-1] + 10.0 + delay_s)
    recording = Recording.open(writer.close())
    samples, fit = recording.read_samples(), recording.read_channel("clock")
    assert (np.diff(samples.host_time_s) >= 0.0).all()
    error_s = samples.host_time_s - samples.device_time_s - 10.0
    assert 1e-3 <= error_s[-1] < 1.2e-3
    assert error_s.min() >= 1e-3 - 1e-12
    assert fit["uncertainty_s"][-1] == pytest.approx(4e-3, abs=1e-3)
    assert (np.abs(fit["offset_s"][50:] - 10.0) <= fit["uncertainty_s"][50:]).all()


def test_a_device_time_that_goes_back_starts_another_connection(make_writer, feed, make_samples):
    writer = make_writer()
    writer.start_connection()
    feed(writer, 0, 100)
    feed(writer, 40, 60)  # without start_connection()
    writer.start_connection()
    feed(writer, 0, 20)
    samples = Recording.open(writer.close()).read_samples()
    np.testing.assert_array_equal(samples.connection, np.repeat([1, 2, 3], [100, 60, 20]))
    assert (np.diff(samples.host_time_s) > 0.0).all()


def test_a_full_disk_is_reported_once_and_loses_nothing(make_writer, feed, check, disk, notices):
    writer = make_writer()
    feed(writer, 0, 200)
    writer.run_once()
    disk.room = writer.bytes_written + 100
    for number in range(1, 6):
        feed(writer, 200 * number, 200)
        writer.run_once()
    (notice,) = notices
    assert "No space left" in notice
    assert "the motion continues" in notice
    assert writer.failure is not None
    disk.room = None
    writer.run_once()
    assert notices[1:] == [notices[1]]
    assert "the recording continues; nothing is missing" in notices[1]
    feed(writer, 1200, 200)
    writer.run_once()
    disk.room = writer.bytes_written  # for ever
    feed(writer, 1400, 100)
    recording = Recording.open(writer.close())
    check(recording.read_samples(), 0, 1400)
    assert [event.kind for event in recording.read_events()] == ["recorder", "recorder"]
    assert "the end of the recording could not be written" in notices[-1]


def test_samples_without_room_are_counted_and_their_position_marked(make_writer, feed, disk, clock):
    writer = make_writer(capacity_bytes=100_000)
    feed(writer, 0, 200)
    writer.run_once()
    disk.room = writer.bytes_written
    feed(writer, 200, 200)
    writer.run_once()  # these samples wait for the disk
    feed(writer, 400, 4000)
    disk.room = None
    writer.run_once()
    feed(writer, 4400, 200)
    recording = Recording.open(writer.close())
    samples = recording.read_samples()
    (gap,) = [event for event in recording.read_events() if "samples" in event.details]
    numbers = np.rint((samples.device_time_s - 0.25) * 1000.0).astype(int)
    (last_before_gap,) = np.flatnonzero(np.diff(numbers) > 1)
    missing = int(np.diff(numbers)[last_before_gap]) - 1
    assert f"{missing} samples and" in gap.text
    assert numbers[-1] == 4599
    assert (
        samples.host_time_s[last_before_gap]
        < gap.host_time_s
        <= samples.host_time_s[last_before_gap + 1]
    )


def test_without_room_for_the_merged_file_the_recording_stays_recoverable(
    make_writer, feed, check, monkeypatch
):
    writer = make_writer()
    feed(writer, 0, 300)
    with monkeypatch.context() as patched:

        def raise_disk_full(_):
            raise OSError(errno.ENOSPC, "No space left on device")

        writer.run_once()
        patched.setattr("rotemina.sim.files.whole_files.os.fsync", raise_disk_full)
        with pytest.raises(RecordingError, match=r"the recorded data are in .*run.arrows.part"):
            writer.close()
    assert not writer.path.exists()
    assert [path.name for path in writer.path.parent.iterdir()] == ["run.arrows.part"]
    check(
        Recording.open(recover_recording(writer.path.with_name("run.arrows.part"))).read_samples(),
        0,
        300,
    )


def test_a_slow_disk_is_reported_once(make_writer, feed, disk, clock, notices):
    writer = make_writer()
    disk.before = lambda: clock.advance(0.9)
    for number in range(3):
        feed(writer, 100 * number, 100)
        writer.run_once()
    (notice,) = notices
    assert "took 0.9 s for a segment" in notice
    disk.before = lambda: None
    writer.close()


def test_a_disk_that_is_slow_to_confirm_does_not_delay_writing(
    make_writer, feed, check, monkeypatch
):
    """A killed process loses the samples that were not written, however slow the disk is."""
    sync_started, can_finish, written = threading.Event(), threading.Event(), threading.Event()

    def fsync(_):
        sync_started.set()
        assert can_finish.wait(10.0)

    writer = make_writer()
    append = writer._file.append
    with monkeypatch.context() as patched:
        patched.setattr("rotemina.app.motion.recording.segments.os.fsync", fsync)
        writer.start()
        feed(writer, 0, 100)
        assert sync_started.wait(10.0)
        writer._file.append = lambda *contents: (append(*contents), written.set())
        feed(writer, 100, 100)
        assert written.wait(10.0)
        can_finish.set()
        path = writer.close()
    check(Recording.open(path).read_samples(), 0, 200)
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("recorder")]


def test_a_disk_that_fails_at_the_start_is_refused(make_writer, disk, tmp_path):
    disk.room = 10
    with pytest.raises(RecordingError, match=r"cannot be written \(No space left"):
        make_writer()
    assert list(tmp_path.iterdir()) == []


def test_two_recorders_do_not_share_a_file(make_writer, feed, tmp_path):
    writer = make_writer()
    with pytest.raises(RecordingError, match="being recorded or left by a crash"):
        make_writer()
    with pytest.raises(RecordingError, match="still being recorded"):
        recover_recording(tmp_path / "run.arrows.part")
    assert is_being_recorded(tmp_path / "run.arrows.part")
    other = make_writer("other.arrows")
    feed(writer, 0, 20)
    writer.close()
    other.close()
    assert not is_being_recorded(tmp_path / "run.arrows.part")
    with pytest.raises(RecordingError, match="already exists"):
        make_writer()


def test_after_close_nothing_is_recorded_and_an_empty_recording_opens(make_writer, feed):
    writer = make_writer()
    path = writer.close()
    feed(writer, 0, 20)
    writer.add_row("a", 0.0, {"b": 1.0})
    writer.add_event("note", "late")
    writer.run_once()
    assert writer.close() == path
    recording = Recording.open(path)
    assert recording.count == len(recording.read_samples()) == 0
    assert recording.read_events() == ()
    assert recording.ended_s == recording.began_s == 5.0


def test_long_runs_do_not_grow_in_memory_or_handles(make_writer, feed, monkeypatch):
    """After 100 segments, 300 more take no memory, and merging does not hold the whole file."""
    monkeypatch.setattr("rotemina.app.motion.recording.recovery._MIN_BATCH_ROWS", 4096)
    writer = make_writer()

    def record_segments(segments):
        for segment in segments:
            feed(writer, 200 * segment, 200)
            writer.add_event("note", "x" * 100)
            writer.run_once()

    record_segments(range(100))
    handles = count_open_handles()
    tracemalloc.start()
    try:
        record_segments(range(100, 110))
        before, _ = tracemalloc.get_traced_memory()
        record_segments(range(110, 400))
        after, _ = tracemalloc.get_traced_memory()
        size = writer.bytes_written
        tracemalloc.reset_peak()
        writer.close()
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert after - before < 100_000
    assert size > 5_000_000
    assert peak - after < size / 4
    assert count_open_handles() <= handles


def count_open_handles():
    """Return the number of open file handles; 0 on systems that do not list them."""
    descriptors = Path("/proc/self/fd")
    return len(list(descriptors.iterdir())) if descriptors.is_dir() else 0
