"""Recovery: the file left by a crash becomes a recording, and is deleted only then."""

import re
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording import Recording, find_unfinished, recover_recording
from rotemina.app.motion.recording.segments import SegmentFile

DOCUMENT = Path(__file__).parents[4] / "docs" / "recording.md"


@pytest.fixture
def unfinished(make_writer, feed):
    """A recording of 300 samples that was never closed and whose writer has ended."""
    writer = make_writer()
    for number in range(3):
        feed(writer, 100 * number, 100)
        writer.add_row("stick", float(number), {"x": 1.0})
        writer.run_once()
    writer._file.close()
    return writer.path.with_name("run.arrows.part")


def test_an_unfinished_recording_is_found_and_recovered(unfinished, check, tmp_path):
    assert find_unfinished(tmp_path) == (unfinished,)
    path = recover_recording(unfinished)
    assert path == tmp_path / "run.arrows"
    assert find_unfinished(tmp_path) == ()
    check(Recording.open(path).read_samples(), 0, 300)


def test_whole_segments_are_recovered_wherever_the_file_is_cut(unfinished, check):
    data = unfinished.read_bytes()
    for size in range(len(data) - 1, len(data) * 2 // 3, -397):
        unfinished.write_bytes(data[:size])
        path = recover_recording(unfinished)
        samples = Recording.open(path).read_samples()
        assert len(samples) in (200, 300)  # the last segment held samples, or something else
        check(samples, 0, len(samples))
        path.unlink()


def test_recovery_after_a_crash_between_merging_and_deleting(unfinished, check):
    data = unfinished.read_bytes()
    path = recover_recording(unfinished)
    unfinished.write_bytes(data)
    merged = path.read_bytes()
    assert recover_recording(unfinished) == path
    assert not unfinished.exists()
    assert path.read_bytes() == merged


@pytest.mark.parametrize("existing", [b"", b"somebody's", None])
def test_another_file_of_that_name_is_not_overwritten(unfinished, existing, make_writer, tmp_path):
    path = tmp_path / "run.arrows"
    if existing is None:
        existing = make_writer("other.arrows").close().read_bytes()
    path.write_bytes(existing)
    with pytest.raises(RecordingError, match="is another recording; rename it"):
        recover_recording(unfinished)
    assert path.read_bytes() == existing
    assert unfinished.exists()


def test_an_empty_file_and_one_of_another_version_are_not_deleted(tmp_path):
    path = tmp_path / "a.arrows.part"
    SegmentFile(path).close()
    with pytest.raises(RecordingError, match="before anything was recorded"):
        recover_recording(path)
    path.unlink()
    file = SegmentFile(path)
    file.append(b'{"rotemina-recording": "7"}')
    file.close()
    with pytest.raises(RecordingError, match="version 7, but this program reads version 1"):
        recover_recording(path)
    assert path.exists()
    with pytest.raises(RecordingError, match=r"ends with \.part"):
        recover_recording(tmp_path / "a.arrows")


def test_many_segments_become_few_batches(make_writer, feed, check):
    writer = make_writer()
    for number in range(40):
        feed(writer, 5000 * number, 5000, portion=5000)
        writer.run_once()
    recording = Recording.open(writer.close())
    check(recording.read_samples(), 0, 200_000)
    assert len(list(recording.read_pieces())) == 3


def test_a_section_can_be_read(make_writer, feed, check):
    writer = make_writer()
    for number in range(40):
        feed(writer, 5000 * number, 5000, portion=5000)
        writer.run_once()
    recording = Recording.open(writer.close())
    begin_s, end_s = recording.read_samples().host_time_s[[64_000, 141_000]]
    section = recording.read_samples(begin_s, end_s)
    check(section, 64_000, 77_001)
    assert sum(map(len, recording.read_pieces(begin_s, end_s))) == 77_001
    assert len(recording.read_samples(end_s, begin_s)) == 0
    assert not section.command.flags.writeable
    assert not section.host_time_s.flags.writeable


def test_pyarrow_alone_reads_a_recording_as_documented(unfinished, monkeypatch):
    path = recover_recording(unfinished)
    monkeypatch.chdir(path.parent)
    snippet = re.search(r"```python\n(import pyarrow.*?)```", DOCUMENT.read_text("utf-8"), re.S)
    assert "rotemina" not in snippet[1]
    names = {}
    exec(snippet[1], names)  # noqa: S102 - our own document
    tables = names["tables"]
    assert sorted(tables) == ["channel:clock", "channel:stick", "samples"]
    samples = Recording.open(path).read_samples()
    np.testing.assert_array_equal(tables["samples"]["thx.meas"], samples.measured[:, 1])
    assert tables["samples"].schema.field("thx.u").metadata == {b"unit": b"V"}


def test_the_samples_are_the_first_stream_of_the_file(unfinished):
    with pa.memory_map(str(recover_recording(unfinished))) as file:
        table = pa.ipc.open_stream(file).read_all()
    assert table.shape == (300, 12)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "not a recording"),
        (b"t [s],x [m]\n0,1\n" * 10, "not a recording of this program, or damaged"),
        (bytes(200), "not a recording"),
    ],
)
def test_other_files_are_refused(tmp_path, data, message):
    path = tmp_path / "x.arrows"
    path.write_bytes(data)
    with pytest.raises(RecordingError, match=message):
        Recording.open(path)


def test_a_finished_recording_that_is_cut_or_of_another_version_is_refused(unfinished, tmp_path):
    path = recover_recording(unfinished)
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
