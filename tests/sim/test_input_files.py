"""Files that are read: no other than regular ones, and none without an end."""

import os

import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.input_files import open_file, parse_json, parse_toml, read_bytes, read_text


class ReadError(InputError):
    pass


def test_what_a_file_holds_is_read(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b"\xef\xbb\xbf\xc2\xb5m\r\n")
    assert read_bytes(path, ReadError, 8) == b"\xef\xbb\xbf\xc2\xb5m\r\n"
    assert read_text(str(path), ReadError, 8) == "µm\r\n"


def test_what_is_no_file_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path, reason in (
        (tmp_path / "pipe", "a pipe or a device"),
        ("/dev/zero", "a pipe or a device"),
        (tmp_path, "a folder"),
        (tmp_path / "none", "file not found"),
        (tmp_path / "none" / "a", "file not found"),
        ("a" * 300, "File name too long"),
        ("a\0b", "null"),
    ):
        with pytest.raises(ReadError, match=rf"cannot be read \(.*{reason}.*\); name another"):
            open_file(path, ReadError, advice="name another")


def test_a_pipe_that_takes_the_place_of_a_file_is_not_waited_for(tmp_path, monkeypatch):
    """It is looked at once more when it is open."""
    path = tmp_path / "a"
    path.write_bytes(b"")
    before = path.stat()
    path.unlink()
    os.mkfifo(path)
    monkeypatch.setattr("pathlib.Path.stat", lambda self: before)
    with pytest.raises(ReadError, match="a pipe"):
        open_file(path, ReadError)


def test_size_is_bounded_even_where_the_system_does_not_tell_it(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"12345")
    with pytest.raises(ReadError, match="larger than 4 bytes"):
        read_bytes(path, ReadError, 4)
    with pytest.raises(ReadError, match="larger than 4 bytes"):
        read_bytes("/proc/self/status", ReadError, 4)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = ", "not valid TOML"),
        (".".join(["a"] * 50_000) + " = 1", "nested more than"),
        ("a = " + "[" * 5000, "nested more than"),
        ("a = " + "9" * 5000, "not valid TOML"),
        ("a = " + "9" * 400, "400 digits"),
    ],
)
def test_toml_that_is_none_is_refused(text, said):
    with pytest.raises(ReadError, match=f"^it: .*{said}"):
        parse_toml(text, "it", ReadError)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "1: not valid JSON"),
        (b"\xff", "not valid JSON"),
        ("[" * 60 + "]" * 60, "nested more than"),
        ("[" * 100_000, "nested more than"),
        ("[NaN]", "NaN is no number"),
    ],
)
def test_json_that_is_none_is_refused(text, said):
    with pytest.raises(ReadError, match=f"^it:.*{said}"):
        parse_json(text, "it", ReadError)


def test_whole_numbers_stay_whole_as_far_as_a_float_holds_them():
    read = parse_json("[3, 1" + "0" * 400 + "]", "it", ReadError)
    assert read == [3, float("inf")]
    assert isinstance(read[0], int)
