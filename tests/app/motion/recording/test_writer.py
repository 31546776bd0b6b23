"""The writer: what is handed over is there again, and bad disks cost no motion and no past."""

import errno
import threading
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import being_recorded, recover


def test_everything_comes_back_bit_by_bit(make_writer, feed, check, clock):
    writer = make_writer()
    writer.connected()
    writer.event("note", "µ: begin", {"a": [1, 2]})
    for part in range(5):
        feed(writer, 100 * part, 100)
        writer.record("camera", clock(), {"frame": part, "exposure_s": 0.1 * part})
        writer.run_once()
    recording = Recording.open(writer.close())
    check(recording.samples(), 0, 500)
    assert set(recording.samples().connection) == {1}
    assert recording.metadata["robot"] == "two axes"
    assert recording.units == {"x": "m", "thx": "rad"}
    assert [(event.kind, event.text, event.details) for event in recording.events()] == [
        ("note", "µ: begin", '{"a": [1, 2]}')
    ]
    assert recording.channels == ("camera", "clock")
    frames = recording.channel("camera")
    assert list(frames) == ["host_time_s", "frame", "exposure_s"]
    np.testing.assert_array_equal(frames["frame"], np.arange(5.0))
    np.testing.assert_allclose(frames["host_time_s"], 5.0 + 0.1 * np.arange(1, 6), rtol=1e-12)
    assert not writer.path.with_name("run.arrows.part").exists()


def test_an_empty_recording_is_one(make_writer):
    recording = Recording.open(make_writer().close())
    assert recording.count == 0
    assert len(recording.samples()) == 0
    assert recording.events() == ()
    assert recording.ended_s == recording.began_s == 5.0


def test_a_channel_may_gain_and_miss_columns(make_writer):
    writer = make_writer()
    writer.record("stick", 1.0, {"x": 0.5})
    writer.run_once()
    writer.record("stick", 3.0, {"y": 2.0})
    writer.record("stick", 2.0, {"x": 0.25, "y": 1.0})
    stick = Recording.open(writer.close()).channel("stick")
    np.testing.assert_array_equal(stick["host_time_s"], [1.0, 2.0, 3.0])
    np.testing.assert_array_equal(stick["x"], [0.5, 0.25, np.nan])
    np.testing.assert_array_equal(stick["y"], [np.nan, 1.0, 2.0])


def test_host_times_follow_the_soonest_arrivals_and_never_go_back(make_writer, numbered, clock):
    """The device's clock is 10 s off and its samples come in 1 to 9 ms late."""
    rng = np.random.default_rng(5)
    writer = make_writer()
    for first in range(0, 4000, 20):
        samples = numbered(first, 20)
        late_s = 1e-3 + 8e-3 * rng.random()
        writer.add(samples, samples.command, samples.device_time_s[-1] + 10.0 + late_s)
    recording = Recording.open(writer.close())
    samples, fit = recording.samples(), recording.channel("clock")
    assert (np.diff(samples.host_time_s) >= 0.0).all()
    error_s = samples.host_time_s - samples.device_time_s - 10.0
    assert 1e-3 <= error_s[-1] < 1.2e-3
    assert error_s.min() >= 1e-3 - 1e-12
    assert fit["uncertainty_s"][-1] == pytest.approx(4e-3, abs=1e-3)
    assert (np.abs(fit["offset_s"][50:] - 10.0) <= fit["uncertainty_s"][50:]).all()


def test_a_device_time_that_begins_anew_is_another_connection(make_writer, feed, numbered):
    writer = make_writer()
    writer.connected()
    feed(writer, 0, 100)
    feed(writer, 40, 60)  # nobody has said so
    writer.connected()
    feed(writer, 0, 20)
    samples = Recording.open(writer.close()).samples()
    np.testing.assert_array_equal(samples.connection, np.repeat([1, 2, 3], [100, 60, 20]))
    assert (np.diff(samples.host_time_s) > 0.0).all()


def test_a_full_disk_is_told_once_and_costs_nothing(make_writer, feed, check, disk, notices):
    writer = make_writer()
    feed(writer, 0, 200)
    writer.run_once()
    disk.room = writer.bytes_written + 100
    for part in range(1, 6):
        feed(writer, 200 * part, 200)
        writer.run_once()
    (told,) = notices
    assert "No space left" in told
    assert "the motion continues" in told
    assert writer.failure is not None
    disk.room = None
    writer.run_once()
    assert notices[1:] == [notices[1]]
    assert "the recording continues; nothing is missing" in notices[1]
    feed(writer, 1200, 200)
    recording = Recording.open(writer.close())
    check(recording.samples(), 0, 1400)
    assert [event.kind for event in recording.events()] == ["recorder", "recorder"]


def test_what_finds_no_room_is_counted_and_its_place_marked(make_writer, feed, disk, clock):
    writer = make_writer(capacity_bytes=100_000)
    feed(writer, 0, 200)
    writer.run_once()
    disk.room = writer.bytes_written
    feed(writer, 200, 200)
    writer.run_once()  # this much waits for the disk
    feed(writer, 400, 4000)
    disk.room = None
    writer.run_once()
    feed(writer, 4400, 200)
    recording = Recording.open(writer.close())
    kept = recording.samples()
    (gap,) = [event for event in recording.events() if "samples" in event.details]
    kept_numbers = np.rint((kept.device_time_s - 0.25) * 1000.0).astype(int)
    (at,) = np.flatnonzero(np.diff(kept_numbers) > 1)
    missing = int(np.diff(kept_numbers)[at]) - 1
    assert f"{missing} samples and" in gap.text
    assert kept_numbers[-1] == 4599
    assert kept.host_time_s[at] < gap.host_time_s <= kept.host_time_s[at + 1]


def test_a_disk_that_stays_full_keeps_what_was_recorded(make_writer, feed, check, disk, notices):
    writer = make_writer()
    feed(writer, 0, 300)
    writer.run_once()
    disk.room = writer.bytes_written
    feed(writer, 300, 100)
    recording = Recording.open(writer.close())
    check(recording.samples(), 0, 300)
    assert "the end of the recording could not be written" in notices[-1]


def test_no_room_for_the_merged_file_leaves_what_can_be_recovered(
    make_writer, feed, check, monkeypatch
):
    writer = make_writer()
    feed(writer, 0, 300)
    with monkeypatch.context() as patched:

        def full(_):
            raise OSError(errno.ENOSPC, "No space left on device")

        writer.run_once()
        patched.setattr("rotemina.sim.whole_files.os.fsync", full)
        with pytest.raises(RecordingError, match=r"the recorded data are in .*run.arrows.part"):
            writer.close()
    assert not writer.path.exists()
    assert [each.name for each in writer.path.parent.iterdir()] == ["run.arrows.part"]
    check(Recording.open(recover(writer.path.with_name("run.arrows.part"))).samples(), 0, 300)


def test_a_slow_disk_is_told_once(make_writer, feed, disk, clock, notices):
    writer = make_writer()
    disk.before = lambda: clock.advance(0.9)
    for part in range(3):
        feed(writer, 100 * part, 100)
        writer.run_once()
    (told,) = notices
    assert "took 0.9 s for a segment" in told
    disk.before = lambda: None
    writer.close()


def test_a_disk_that_is_slow_to_confirm_keeps_nobody_from_writing(
    make_writer, feed, check, monkeypatch
):
    """A killed process loses what was not written, however long the disk takes."""
    begun, go_on, written = threading.Event(), threading.Event(), threading.Event()

    def fsync(_):
        begun.set()
        assert go_on.wait(10.0)

    writer = make_writer()
    append = writer._file.append
    with monkeypatch.context() as patched:
        patched.setattr("rotemina.app.motion.recording.segments.os.fsync", fsync)
        writer.start()
        feed(writer, 0, 100)
        assert begun.wait(10.0)
        writer._file.append = lambda *contents: (append(*contents), written.set())
        feed(writer, 100, 100)
        assert written.wait(10.0)
        go_on.set()
        path = writer.close()
    check(Recording.open(path).samples(), 0, 200)


def test_a_failing_disk_from_the_begin_is_refused(make_writer, disk, tmp_path):
    disk.room = 10
    with pytest.raises(RecordingError, match=r"cannot be written \(No space left"):
        make_writer()
    assert list(tmp_path.iterdir()) == []


def test_two_recorders_do_not_meet(make_writer, feed, tmp_path):
    writer = make_writer()
    with pytest.raises(RecordingError, match="being recorded or left by a crash"):
        make_writer()
    with pytest.raises(RecordingError, match="still being recorded"):
        recover(tmp_path / "run.arrows.part")
    assert being_recorded(tmp_path / "run.arrows.part")
    other = make_writer("other.arrows")
    feed(writer, 0, 20)
    writer.close()
    other.close()
    assert not being_recorded(tmp_path / "run.arrows.part")
    with pytest.raises(RecordingError, match="already exists"):
        make_writer()


def test_after_close_nothing_is_taken(make_writer, feed):
    writer = make_writer()
    path = writer.close()
    feed(writer, 0, 20)
    writer.record("a", 0.0, {"b": 1.0})
    writer.event("note", "late")
    writer.run_once()
    assert writer.close() == path
    assert Recording.open(path).count == 0


def test_the_thread_writes_by_itself(make_writer, feed, check):
    writer = make_writer()
    written = threading.Event()
    append = writer._file.append
    writer._file.append = lambda *contents: (append(*contents), written.set())
    writer.start()
    feed(writer, 0, 100)
    assert written.wait(10.0)
    check(Recording.open(writer.close()).samples(), 0, 100)
    assert not [each for each in threading.enumerate() if each.name.startswith("recorder")]


def test_long_runs_grow_neither_in_memory_nor_in_handles(make_writer, feed, monkeypatch):
    """Three hundred segments after a hundred take no byte more, nor does merging hold the file."""
    monkeypatch.setattr("rotemina.app.motion.recording.recovery._ROWS", 4096)
    writer = make_writer()

    def live(segments):
        for segment in segments:
            feed(writer, 200 * segment, 200)
            writer.event("note", "x" * 100)
            writer.run_once()

    live(range(100))
    handles = open_handles()
    tracemalloc.start()
    try:
        live(range(100, 110))
        before, _ = tracemalloc.get_traced_memory()
        live(range(110, 400))
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
    assert open_handles() <= handles


def open_handles():
    """Return how many there are, where the system tells."""
    told = Path("/proc/self/fd")
    return len(list(told.iterdir())) if told.is_dir() else 0
