"""Bounds: no file fills the memory or keeps the program busy."""

import gzip
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.sim.records.file_blocks import Block, Limits, open_blocks
from rotemina.sim.records.preview import preview
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import RecordError

WriteFile = Callable[..., Path]

HEAD = "t [s],x [m]\n"


def rows(count: int) -> str:
    return "".join(f"{second},1\n" for second in range(count))


@pytest.mark.parametrize("block_bytes", [1, 7, 50, 10_000])
def test_blocks_hold_whole_lines(write_file: WriteFile, block_bytes: int) -> None:
    content = (HEAD + rows(30)).encode()
    with open_blocks(write_file(content[:-1]), Limits(block_bytes=block_bytes)) as blocks:
        parts = list(blocks)
    assert b"".join(part.data for part in parts) == content
    assert all(part.data.endswith(b"\n") for part in parts)
    line = 1
    for part in parts:
        assert part.first_line == line
        line += part.lines


def test_a_block_tells_lines_from_offsets() -> None:
    block = Block(7, b"ab\ncd\n")
    assert [block.line_of(offset) for offset in range(6)] == [7, 7, 7, 8, 8, 8]


@pytest.mark.parametrize("line_bytes", [20, 21, 40])
@pytest.mark.parametrize("block_bytes", [1, 10, 64, 1000])
def test_a_line_may_be_as_long_as_stated(
    write_file: WriteFile, line_bytes: int, block_bytes: int
) -> None:
    limits = Limits(line_bytes=line_bytes, block_bytes=block_bytes)
    longest = "5," + "1" * (line_bytes - 2)
    record = read_record(write_file(HEAD + rows(5) + longest + "\n6,1\n"), limits=limits)
    assert len(record.time_s) == 7
    for end in ("\n6,1\n", "\n", ""):
        path = write_file(HEAD + rows(5) + longest + "1" + end)
        with pytest.raises(RecordError, match=rf"run.csv:7: .* longer than {line_bytes} bytes"):
            read_record(path, limits=limits)


@pytest.mark.parametrize("packed", [False, True])
def test_a_line_without_end_needs_little_memory(tmp_path: Path, packed: bool) -> None:
    path = tmp_path / "long.csv"
    with (gzip.open if packed else open)(path, "wb") as file:  # type: ignore[operator]
        for _ in range(100):
            file.write(b"1" * 1_000_000)
    tracemalloc.start()
    try:
        with pytest.raises(RecordError, match=r"long.csv:1: .* longer than 1000000 bytes"):
            read_record(path)
        _, peak_bytes = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak_bytes < 60_000_000


def test_a_compressed_file_may_expand_as_far_as_stated(write_file: WriteFile) -> None:
    content = (HEAD + rows(1000)).encode()
    path = write_file(gzip.compress(content))
    enough = Limits(expanded_bytes=len(content), block_bytes=100)
    assert len(read_record(path, limits=enough).time_s) == 1000
    short = Limits(expanded_bytes=len(content) - 1, block_bytes=100)
    with pytest.raises(RecordError, match=r"run.csv:\d+: the compressed file expands to more than"):
        read_record(path, limits=short)


@pytest.mark.parametrize("filler", [b"\n", b"# \n", b"#a:b\n", b" " * 1000 + b"\n"])
def test_an_expanding_file_is_given_up_early(tmp_path: Path, filler: bytes) -> None:
    path = tmp_path / "bomb.csv.gz"
    with gzip.open(path, "wb") as file:
        for _ in range(30):
            file.write(filler * (1_000_000 // len(filler)))
    limits = Limits(expanded_bytes=2_000_000, comment_bytes=100_000, block_bytes=100_000)
    tracemalloc.start()
    try:
        with pytest.raises(RecordError, match=r"expands to more than|too many bytes of comments"):
            read_record(path, limits=limits)
        _, peak_bytes = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak_bytes < 3_000_000


@pytest.mark.parametrize("block_bytes", [1, 100, 10_000])
def test_comments_are_bounded(write_file: WriteFile, block_bytes: int) -> None:
    path = write_file("# a: b\n" * 10 + HEAD + "0,1\n# end")
    enough = Limits(comment_bytes=76, block_bytes=block_bytes)
    assert read_record(path, limits=enough).metadata == {"a": "b"}
    with pytest.raises(RecordError, match=r"run.csv:13: too many bytes of comments"):
        read_record(path, limits=Limits(comment_bytes=75, block_bytes=block_bytes))


MANY = range(70_000)


@pytest.mark.parametrize(
    "content",
    [
        HEAD + "0," + "1" * 900_000 + "x\n",
        HEAD + "0," + "1," * 450_000 + "\n",
        HEAD + "0," + " " * 900_000 + "#\n",
        "t [s]," + "[" * 900_000 + "\n0,1\n",
        "t [s] " + "x [m" * 200_000 + "\n0,1\n",
        "x" * 900_000 + "\n",
        "t [s]," + ",".join(f"a{number}[m]" for number in MANY) + "\n0\n",
        "t [s]," + ",".join(f"a{number}.u[V]" for number in MANY) + "\n0\n",
        "".join(f"#a:{number}\n" for number in range(300_000)) + HEAD,
    ],
    ids=["digits", "fields", "blanks", "brackets", "open", "word", "axes", "voltages", "key"],
)
def test_hostile_text_is_refused_in_linear_time(
    content: str, write_file: WriteFile, limits: Limits
) -> None:
    # Anything quadratic in a megabyte would not end today.
    with pytest.raises(RecordError) as caught:
        read_record(write_file(content), limits=replace(limits, block_bytes=16_000_000))
    assert len(str(caught.value)) < 500


def test_values_are_bounded(write_file: WriteFile) -> None:
    path = write_file(HEAD + rows(1000))
    assert len(read_record(path, limits=Limits(values=2000, block_bytes=100)).time_s) == 1000
    with pytest.raises(RecordError, match=r"run.csv:\d+: more than 1999 values; split the file"):
        read_record(path, limits=Limits(values=1999, block_bytes=100))
    with pytest.raises(RecordError, match=r"run.csv:2: more than 1999 values; split the file"):
        read_record(path, limits=Limits(values=1999))


def test_an_error_of_the_disk_is_worded(
    write_file: WriteFile, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Failing:
        def read(self, _: int) -> bytes:
            raise OSError(5, "Input/output error")

        peek = read

    path = write_file(gzip.compress(HEAD.encode()))
    monkeypatch.setattr(gzip, "GzipFile", lambda **_: Failing())
    with pytest.raises(RecordError, match=r"run.csv:1: reading failed .*Input/output error"):
        preview(path)
