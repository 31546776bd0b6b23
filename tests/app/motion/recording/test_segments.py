"""Segments: what was written whole is found again, whatever has become of the rest."""

import errno

import pytest

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.segments import MAGIC, SegmentFile, WholeSegments

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


def found(path):
    with WholeSegments(path) as segments:
        return [content for _, content in segments]


def test_segments_come_back(path):
    sizes = write(path, CONTENTS)
    assert found(path) == CONTENTS
    assert sizes[-1] == path.stat().st_size
    with WholeSegments(path) as segments:
        places = [place for place, _ in segments]
        assert [segments.read(place) for place in places] == CONTENTS


def test_torn_at_any_byte_of_the_last_segment_the_others_are_kept(path):
    *_, before, whole = write(path, CONTENTS)
    data = path.read_bytes()
    for size in range(before, whole):
        path.write_bytes(data[:size])
        assert found(path) == CONTENTS[:-1]
        path.write_bytes(data[:size] + bytes(whole - size))  # a size without its contents
        assert found(path) == CONTENTS[:-1]


def test_any_changed_byte_of_the_last_segment_is_seen(path):
    *_, before, whole = write(path, CONTENTS)
    data = bytearray(path.read_bytes())
    for at in range(before, whole):
        data[at] ^= 0x10
        path.write_bytes(data)
        assert found(path) == CONTENTS[:-1]
        data[at] ^= 0x10


def test_a_segment_out_of_turn_is_none(path, tmp_path):
    """As an older file's that shows through: valid in itself, but not the next."""
    sizes = write(path, CONTENTS[:2])
    data = path.read_bytes()
    path.write_bytes(data + data[: sizes[0]])
    assert found(path) == CONTENTS[:2]


def test_a_full_disk_keeps_what_there_is_and_is_tried_again(path, disk):
    disk.room = 250
    file = SegmentFile(path, disk.open)
    file.append(b"a" * 100)
    for _ in range(2):
        with pytest.raises(OSError, match="No space") as caught:
            file.append(b"b" * 100, b"c" * 100)
        assert caught.value.errno == errno.ENOSPC
        assert path.stat().st_size == file.size == 128
    disk.room = None
    file.append(b"b" * 100, b"c" * 100)
    file.close()
    assert found(path) == [b"a" * 100, b"b" * 100, b"c" * 100]


def test_what_the_disk_fails_to_confirm_is_written_again(path, monkeypatch):
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
    assert found(path) == [b"kept", b"not confirmed", b"nor this", b"new"]


def test_a_disk_that_never_confirms_is_not_given_more_and_more(path, monkeypatch):
    monkeypatch.setattr("rotemina.app.motion.recording.segments._MOST_UNCONFIRMED", 100)
    file = SegmentFile(path)
    file.append(b"a" * 101)
    with pytest.raises(OSError, match="does not confirm"):
        file.append(b"b")
    file.sync()
    file.append(b"b")
    file.close()
    assert found(path) == [b"a" * 101, b"b"]


def test_a_file_that_is_being_written_is_left_alone(path):
    file = SegmentFile(path)
    file.append(b"one")
    with pytest.raises(RecordingError, match="still being recorded"):
        WholeSegments(path)
    file.close()
    assert found(path) == [b"one"]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "before anything was recorded; delete it"),
        (MAGIC[:5], "before anything was recorded; delete it"),
        (
            MAGIC[:6] + b"99" + bytes(100),
            "version 99, but this program reads version 01",
        ),
        (b"PK\x03\x04" + bytes(100), "not an interrupted recording of this program"),
    ],
)
def test_other_files_are_refused(path, data, words):
    path.write_bytes(data)
    with pytest.raises(RecordingError, match=words):
        WholeSegments(path)
    assert path.read_bytes() == data


def test_a_file_that_cannot_be_made_or_read_is_named(tmp_path, path):
    with pytest.raises(RecordingError, match=r"nowhere/run.part: cannot be created"):
        SegmentFile(tmp_path / "nowhere" / "run.part")
    with pytest.raises(RecordingError, match="cannot be read"):
        WholeSegments(path)
    write(path, CONTENTS)
    with pytest.raises(RecordingError, match="already exists"):
        SegmentFile(path)
