"""Segments: whole segments are read back, whatever happened to the rest of the file."""

import errno

import pytest

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording.segments import SEGMENT_MAGIC, SegmentFile, SegmentReader

CONTENTS = [b"first", b"", b"x" * 1000, b"last" * 10]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "run.part"


def write(path, contents, **options):
    file = SegmentFile(path, **options)
    sizes = []
    for content in contents:
        file.append(content)
        sizes.append(file.size)
    file.close()
    return sizes


def read_contents(path):
    with SegmentReader(path) as segments:
        return [content for _, content in segments]


def test_segments_read_back(path):
    sizes = write(path, CONTENTS)
    assert read_contents(path) == CONTENTS
    assert sizes[-1] == path.stat().st_size
    with SegmentReader(path) as segments:
        offsets = [offset for offset, _ in segments]
        assert [segments.read(offset) for offset in offsets] == CONTENTS


def test_a_cut_in_the_last_segment_keeps_the_others(path):
    *_, previous_size, full_size = write(path, CONTENTS)
    data = path.read_bytes()
    for size in range(previous_size, full_size):
        path.write_bytes(data[:size])
        assert read_contents(path) == CONTENTS[:-1]
        path.write_bytes(data[:size] + bytes(full_size - size))  # a size without its contents
        assert read_contents(path) == CONTENTS[:-1]


def test_any_changed_byte_of_the_last_segment_is_detected(path):
    *_, previous_size, full_size = write(path, CONTENTS)
    data = bytearray(path.read_bytes())
    for at in range(previous_size, full_size):
        data[at] ^= 0x10
        path.write_bytes(data)
        assert read_contents(path) == CONTENTS[:-1]
        data[at] ^= 0x10


def test_a_segment_out_of_order_is_ignored(path, tmp_path):
    """Like a leftover segment of an older file: valid, but not the next one."""
    sizes = write(path, CONTENTS[:2])
    data = path.read_bytes()
    path.write_bytes(data + data[: sizes[0]])
    assert read_contents(path) == CONTENTS[:2]


def test_unconfirmed_segments_are_written_again(path, monkeypatch):
    file = SegmentFile(path)
    file.append(b"kept")
    file.sync()
    with monkeypatch.context() as patched:
        patched.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(errno.EIO, "bad")))
        file.append(b"not confirmed")
        file.append(b"nor this")
        with pytest.raises(OSError, match="bad"):
            file.sync()
    assert file.size == 28 + 4
    file.append(b"new")
    file.sync()
    file.close()
    assert read_contents(path) == [b"kept", b"not confirmed", b"nor this", b"new"]


def test_unconfirmed_bytes_are_limited(path, monkeypatch):
    monkeypatch.setattr("rotemina.app.motion.recording.segments._MAX_UNCONFIRMED_BYTES", 100)
    file = SegmentFile(path)
    file.append(b"a" * 101)
    with pytest.raises(OSError, match="does not confirm"):
        file.append(b"b")
    file.sync()
    file.append(b"b")
    file.close()
    assert read_contents(path) == [b"a" * 101, b"b"]


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "before anything was recorded; delete it"),
        (SEGMENT_MAGIC[:5], "before anything was recorded; delete it"),
        (
            SEGMENT_MAGIC[:6] + b"99" + bytes(100),
            "version 99, but this program reads version 01",
        ),
        (b"PK\x03\x04" + bytes(100), "not an interrupted recording of this program"),
    ],
)
def test_other_files_are_refused(path, data, message):
    path.write_bytes(data)
    with pytest.raises(RecordingError, match=message):
        SegmentReader(path)
    assert path.read_bytes() == data


def test_a_file_that_cannot_be_created_or_read_is_named(tmp_path, path):
    with pytest.raises(RecordingError, match=r"nowhere/run.part: cannot be created"):
        SegmentFile(tmp_path / "nowhere" / "run.part")
    with pytest.raises(RecordingError, match="cannot be read"):
        SegmentReader(path)
    write(path, CONTENTS)
    with pytest.raises(RecordingError, match="already exists"):
        SegmentFile(path)
