"""Recovery: the file left by a crash becomes a recording, and is deleted only then."""

import re
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording import (
    Recording,
    find_unfinished,
    recover_recording,
    recovery,
)
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
    data = unfinished.read_bytes()
    assert find_unfinished(tmp_path) == (unfinished,)
    path = recover_recording(unfinished)
    assert path == tmp_path / "run.arrows"
    assert find_unfinished(tmp_path) == ()
    check(Recording.open(path).read_samples(), 0, 300)
    path.unlink()
    unfinished.write_bytes(data[: len(data) * 2 // 3])  # only whole segments count
    check(Recording.open(recover_recording(unfinished)).read_samples(), 0, 200)


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


def test_many_segments_become_few_batches_of_which_a_section_can_be_read(
    make_writer, feed, check, monkeypatch
):
    monkeypatch.setattr(recovery, "_MIN_BATCH_ROWS", 2000)
    writer = make_writer()
    for number in range(20):
        feed(writer, 250 * number, 250, portion=250)
        writer.run_once()
    recording = Recording.open(writer.close())
    check(recording.read_samples(), 0, 5000)
    assert len(list(recording.read_pieces())) == 3
    begin_s, end_s = recording.read_samples().host_time_s[[1600, 3525]]
    section = recording.read_samples(begin_s, end_s)
    check(section, 1600, 1926)
    assert sum(map(len, recording.read_pieces(begin_s, end_s))) == 1926
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
    with pa.memory_map(str(path)) as file:  # the samples are the first stream of the file
        assert pa.ipc.open_stream(file).read_all().shape == (300, 12)


@pytest.mark.parametrize(
    ("data", "message"),
    [
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
    for size in (0, 5, len(data) // 2, len(data) - 9):
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
