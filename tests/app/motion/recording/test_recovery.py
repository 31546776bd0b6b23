"""Recovery: what a crash has left becomes a recording, and is deleted only then."""

import re
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import recover, unfinished
from rotemina.app.motion.recording.segments import SegmentFile

DOCUMENT = Path(__file__).parents[4] / "docs" / "recording.md"


@pytest.fixture
def crashed(make_writer, feed):
    """A recording of 300 samples that nobody closed; who wrote it is gone."""
    writer = make_writer()
    for part in range(3):
        feed(writer, 100 * part, 100)
        writer.record("stick", float(part), {"x": 1.0})
        writer.run_once()
    writer._file.close()
    return writer.path.with_name("run.arrows.part")


def test_a_crash_is_found_and_recovered(crashed, check, tmp_path):
    assert unfinished(tmp_path) == (crashed,)
    path = recover(crashed)
    assert path == tmp_path / "run.arrows"
    assert unfinished(tmp_path) == ()
    check(Recording.open(path).samples(), 0, 300)


def test_torn_at_any_place_the_whole_segments_are_recovered(crashed, check):
    data = crashed.read_bytes()
    for size in range(len(data) - 1, len(data) * 2 // 3, -397):
        crashed.write_bytes(data[:size])
        path = recover(crashed)
        samples = Recording.open(path).samples()
        assert len(samples) in (200, 300)  # the last segment was one of samples, or later
        check(samples, 0, len(samples))
        path.unlink()


def test_a_crash_between_merging_and_deleting(crashed, check):
    data = crashed.read_bytes()
    path = recover(crashed)
    crashed.write_bytes(data)
    merged = path.read_bytes()
    assert recover(crashed) == path
    assert not crashed.exists()
    assert path.read_bytes() == merged


@pytest.mark.parametrize("there", [b"", b"somebody's", None])
def test_another_file_of_that_name_is_not_overwritten(crashed, there, make_writer, tmp_path):
    path = tmp_path / "run.arrows"
    if there is None:
        there = make_writer("other.arrows").close().read_bytes()
    path.write_bytes(there)
    with pytest.raises(RecordingError, match="is another recording; rename it"):
        recover(crashed)
    assert path.read_bytes() == there
    assert crashed.exists()


def test_what_holds_nothing_or_is_of_another_version_stays(tmp_path):
    path = tmp_path / "a.arrows.part"
    SegmentFile(path).close()
    with pytest.raises(RecordingError, match="before anything was recorded"):
        recover(path)
    path.unlink()
    file = SegmentFile(path)
    file.append(b'{"rotemina-recording": "7"}')
    file.close()
    with pytest.raises(RecordingError, match="version 7, but this program reads version 1"):
        recover(path)
    assert path.exists()
    with pytest.raises(RecordingError, match=r"ends with \.part"):
        recover(tmp_path / "a.arrows")


def test_many_segments_become_few_batches(make_writer, feed, check):
    writer = make_writer()
    for part in range(40):
        feed(writer, 5000 * part, 5000, portion=5000)
        writer.run_once()
    recording = Recording.open(writer.close())
    check(recording.samples(), 0, 200_000)
    assert len(list(recording.pieces())) == 3


def test_a_stretch_of_it(make_writer, feed, check):
    writer = make_writer()
    for part in range(40):
        feed(writer, 5000 * part, 5000, portion=5000)
        writer.run_once()
    recording = Recording.open(writer.close())
    begin_s, end_s = recording.samples().host_time_s[[64_000, 141_000]]
    stretch = recording.samples(begin_s, end_s)
    check(stretch, 64_000, 77_001)
    assert sum(map(len, recording.pieces(begin_s, end_s))) == 77_001
    assert len(recording.samples(end_s, begin_s)) == 0
    assert not stretch.command.flags.writeable
    assert not stretch.host_time_s.flags.writeable


def test_pyarrow_alone_reads_it_as_documented(crashed, monkeypatch):
    path = recover(crashed)
    monkeypatch.chdir(path.parent)
    snippet = re.search(r"```python\n(import pyarrow.*?)```", DOCUMENT.read_text("utf-8"), re.S)
    assert "rotemina" not in snippet[1]
    names = {}
    exec(snippet[1], names)  # noqa: S102 - our own document
    tables = names["tables"]
    assert sorted(tables) == ["channel:clock", "channel:stick", "samples"]
    recorded = Recording.open(path).samples()
    np.testing.assert_array_equal(tables["samples"]["thx.meas"], recorded.measured[:, 1])
    assert tables["samples"].schema.field("thx.u").metadata == {b"unit": b"V"}


def test_polars_reads_the_samples_in_one_line(crashed):
    import polars

    frame = polars.read_ipc_stream(recover(crashed))
    assert frame.shape == (300, 12)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "not a recording"),
        (b"t [s],x [m]\n0,1\n" * 10, "not a recording of this program, or damaged"),
        (bytes(200), "not a recording"),
    ],
)
def test_other_files_are_refused(tmp_path, data, words):
    path = tmp_path / "x.arrows"
    path.write_bytes(data)
    with pytest.raises(RecordingError, match=words):
        Recording.open(path)


def test_a_finished_recording_that_is_cut_or_of_another_version_is_refused(crashed, tmp_path):
    path = recover(crashed)
    data = path.read_bytes()
    for size in (0, 5, 700, len(data) // 2, len(data) - 9):
        path.write_bytes(data[:size])
        with pytest.raises(RecordingError, match=re.escape(str(path))):
            Recording.open(path)
    path.write_bytes(data.replace(b"rotemina-recording", b"rotemina-recordinh"))
    with pytest.raises(RecordingError, match="not a recording of this program"):
        Recording.open(path)
    with pytest.raises(RecordingError, match="cannot be read"):
        Recording.open(tmp_path / "none.arrows")
    with pytest.raises(RecordingError, match="recover it first"):
        Recording.open(tmp_path / "a.arrows.part")
