"""Reading of files: only regular ones, and only up to a maximum size."""

import os

import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.files import (
    open_file,
    parse_json,
    parse_toml,
    read_bytes,
    read_text,
)


class ReadError(InputError):
    pass


def test_the_content_of_a_file_is_read(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b"\xef\xbb\xbf\xc2\xb5m\r\n")
    assert read_bytes(path, ReadError, 8) == b"\xef\xbb\xbf\xc2\xb5m\r\n"
    assert read_text(str(path), ReadError, 8) == "µm\r\n"


def test_paths_that_are_no_regular_file_are_refused_without_waiting(tmp_path):
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


def test_a_pipe_that_replaces_a_file_is_refused_without_waiting(tmp_path, monkeypatch):
    """The file is checked again after it was opened."""
    path = tmp_path / "a"
    path.write_bytes(b"")
    stat_of_file = path.stat()
    path.unlink()
    os.mkfifo(path)
    monkeypatch.setattr("pathlib.Path.stat", lambda self: stat_of_file)
    with pytest.raises(ReadError, match="a pipe"):
        open_file(path, ReadError)


def test_the_size_is_limited_even_if_the_system_does_not_report_it(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"12345")
    with pytest.raises(ReadError, match="larger than 4 bytes"):
        read_bytes(path, ReadError, 4)
    with pytest.raises(ReadError, match="larger than 4 bytes"):
        read_bytes("/proc/self/status", ReadError, 4)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a = ", "not valid TOML"),
        (".".join(["a"] * 50_000) + " = 1", "nested more than"),
        ("a = " + "[" * 5000, "nested more than"),
        ("a = " + "9" * 5000, "not valid TOML"),
        ("a = " + "9" * 400, "400 digits"),
    ],
)
def test_invalid_toml_is_refused(text, message):
    with pytest.raises(ReadError, match=f"^it: .*{message}"):
        parse_toml(text, "it", ReadError)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "1: not valid JSON"),
        (b"\xff", "not valid JSON"),
        ("[" * 60 + "]" * 60, "nested more than"),
        ("[" * 100_000, "nested more than"),
        ("[NaN]", "NaN is not a JSON number"),
    ],
)
def test_invalid_json_is_refused(text, message):
    with pytest.raises(ReadError, match=f"^it:.*{message}"):
        parse_json(text, "it", ReadError)


def test_integers_stay_integers_unless_a_float_overflows():
    values = parse_json("[3, 1" + "0" * 400 + "]", "it", ReadError)
    assert values == [3, float("inf")]
    assert isinstance(values[0], int)
