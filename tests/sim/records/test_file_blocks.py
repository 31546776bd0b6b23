"""Limits of files: no file can fill the memory or keep the program busy."""

import gzip
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.sim.errors import RecordError
from rotemina.sim.records import FileLimits, open_blocks, read_preview, read_record
from rotemina.sim.records.file_blocks import LineBlock

WriteFile = Callable[..., Path]

HEAD = "t [s],x [m]\n"


def format_rows(count: int) -> str:
    return "".join(f"{second},1\n" for second in range(count))


@pytest.mark.parametrize("block_bytes", [1, 50, 10_000])
def test_blocks_contain_whole_lines(write_file: WriteFile, block_bytes: int) -> None:
    content = (HEAD + format_rows(30)).encode()
    with open_blocks(write_file(content[:-1]), FileLimits(block_bytes=block_bytes)) as blocks:
        parts = list(blocks)
    assert b"".join(part.data for part in parts) == content
    assert all(part.data.endswith(b"\n") for part in parts)
    line = 1
    for part in parts:
        assert part.first_line == line
        line += part.lines


def test_a_block_converts_offsets_to_line_numbers() -> None:
    block = LineBlock(7, b"ab\ncd\n")
    assert [block.line_of(offset) for offset in range(6)] == [7, 7, 7, 8, 8, 8]


@pytest.mark.parametrize(
    ("line_bytes", "block_bytes"), [(20, 1), (21, 10), (40, 10), (21, 64), (20, 1000)]
)
def test_a_line_may_have_at_most_its_maximum_length(
    write_file: WriteFile, line_bytes: int, block_bytes: int
) -> None:
    limits = FileLimits(line_bytes=line_bytes, block_bytes=block_bytes)
    longest = "5," + "1" * (line_bytes - 2)
    record = read_record(write_file(HEAD + format_rows(5) + longest + "\n6,1\n"), limits=limits)
    assert len(record.time_s) == 7
    for end in ("\n6,1\n", "\n", ""):
        path = write_file(HEAD + format_rows(5) + longest + "1" + end)
        with pytest.raises(RecordError, match=rf"run.csv:7: .* longer than {line_bytes} bytes"):
            read_record(path, limits=limits)


@pytest.mark.parametrize("is_compressed", [False, True])
def test_a_line_without_end_needs_little_memory(tmp_path: Path, is_compressed: bool) -> None:
    path = tmp_path / "long.csv"
    with (gzip.open if is_compressed else open)(path, "wb") as file:  # type: ignore[operator]
        for _ in range(80):
            file.write(b"1" * 1_000_000)
    tracemalloc.start()
    try:
        with pytest.raises(RecordError, match=r"long.csv:1: .* longer than 1000000 bytes"):
            read_record(path)
        _, peak_bytes = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak_bytes < 60_000_000


def test_a_compressed_file_may_expand_to_its_maximum_size(write_file: WriteFile) -> None:
    content = (HEAD + format_rows(1000)).encode()
    path = write_file(gzip.compress(content))
    sufficient_limits = FileLimits(expanded_bytes=len(content), block_bytes=100)
    assert len(read_record(path, limits=sufficient_limits).time_s) == 1000
    short_limits = FileLimits(expanded_bytes=len(content) - 1, block_bytes=100)
    with pytest.raises(RecordError, match=r"run.csv:\d+: the compressed file expands to more than"):
        read_record(path, limits=short_limits)


@pytest.mark.parametrize("filler", [b"\n", b"#a:b\n", b" " * 1000 + b"\n"])
def test_a_file_that_expands_too_much_is_abandoned_early(tmp_path: Path, filler: bytes) -> None:
    path = tmp_path / "bomb.csv.gz"
    with gzip.open(path, "wb") as file:
        for _ in range(10):
            file.write(filler * (1_000_000 // len(filler)))
    limits = FileLimits(expanded_bytes=2_000_000, comment_bytes=100_000, block_bytes=100_000)
    tracemalloc.start()
    try:
        with pytest.raises(RecordError, match=r"expands to more than|too many bytes of comments"):
            read_record(path, limits=limits)
        _, peak_bytes = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak_bytes < 3_000_000


@pytest.mark.parametrize("block_bytes", [1, 10_000])
def test_the_size_of_comments_is_limited(write_file: WriteFile, block_bytes: int) -> None:
    path = write_file("# a: b\n" * 10 + HEAD + "0,1\n# end")
    sufficient_limits = FileLimits(comment_bytes=76, block_bytes=block_bytes)
    assert read_record(path, limits=sufficient_limits).metadata == {"a": "b"}
    with pytest.raises(RecordError, match=r"run.csv:13: too many bytes of comments"):
        read_record(path, limits=FileLimits(comment_bytes=75, block_bytes=block_bytes))


COLUMN_NUMBERS = range(70_000)


@pytest.mark.parametrize(
    "content",
    [
        HEAD + "0," + "1" * 900_000 + "x\n",
        HEAD + "0," + "1," * 450_000 + "\n",
        HEAD + "0," + " " * 900_000 + "#\n",
        "t [s]," + "[" * 900_000 + "\n0,1\n",
        "t [s] " + "x [m" * 200_000 + "\n0,1\n",
        "x" * 900_000 + "\n",
        "t [s]," + ",".join(f"a{number}[m]" for number in COLUMN_NUMBERS) + "\n0\n",
        "t [s]," + ",".join(f"a{number}.u[V]" for number in COLUMN_NUMBERS) + "\n0\n",
        "".join(f"#a:{number}\n" for number in range(300_000)) + HEAD,
    ],
    ids=["digits", "fields", "blanks", "brackets", "open", "word", "axes", "voltages", "key"],
)
def test_hostile_text_is_refused_in_linear_time(
    content: str, write_file: WriteFile, limits: FileLimits
) -> None:
    # An algorithm that is quadratic in a megabyte would take hours.
    with pytest.raises(RecordError) as refusal:
        read_record(write_file(content), limits=replace(limits, block_bytes=16_000_000))
    assert len(str(refusal.value)) < 500


def test_the_number_of_values_is_limited(write_file: WriteFile) -> None:
    path = write_file(HEAD + format_rows(1000))
    assert len(read_record(path, limits=FileLimits(values=2000, block_bytes=100)).time_s) == 1000
    with pytest.raises(RecordError, match=r"run.csv:\d+: more than 1999 values; split the file"):
        read_record(path, limits=FileLimits(values=1999, block_bytes=100))
    with pytest.raises(RecordError, match=r"run.csv:2: more than 1999 values; split the file"):
        read_record(path, limits=FileLimits(values=1999))


def test_a_disk_error_is_reported_with_its_reason(
    write_file: WriteFile, monkeypatch: pytest.MonkeyPatch
) -> None:
    class FailingFile:
        def read(self, _: int) -> bytes:
            raise OSError(5, "Input/output error")

        peek = read

    path = write_file(gzip.compress(HEAD.encode()))
    monkeypatch.setattr(gzip, "GzipFile", lambda **_: FailingFile())
    with pytest.raises(RecordError, match=r"run.csv:1: reading failed .*Input/output error"):
        read_preview(path)
