"""Records in pieces: equal to whole records, and equally strict anywhere in the file."""

import gzip
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.errors import RecordError
from rotemina.sim.records import (
    FileLimits,
    Record,
    Tap,
    join_records,
    read_pieces,
    read_record,
    write_pieces,
    write_record,
)
from rotemina.sim.robot_files import load_robot

# Blocks of one or two lines and of many, because one block must not affect the next.
SMALL, FAST = FileLimits(small_block_bytes=0, block_bytes=50), FileLimits(small_block_bytes=0)
every_way_to_read = pytest.mark.parametrize(
    ("name", "limits"),
    [("a.csv", FileLimits()), ("a.csv.gz", FAST), ("a.csv", SMALL)],
    ids=["strict", "fast and compressed", "small blocks"],
)


def make_record(rows: int = 1000, start_s: float = 0.0, **metadata: str) -> Record:
    time_s = start_s + np.arange(rows) / 1000
    signals = {("x", Tap.CMD): 0.02 + np.sin(time_s) / 3000, ("x", Tap.U): np.cos(7 * time_s)}
    return Record.from_signals(time_s, signals, {"x": "m"}, metadata)


@every_way_to_read
@pytest.mark.parametrize("rows", [1, 333, 1000, 5000])
def test_pieces_equal_the_record_bit_for_bit(
    tmp_path: Path, rows: int, name: str, limits: FileLimits
) -> None:
    write_record(make_record(note="n"), tmp_path / name, units={"x": "um"})
    pieces = list(read_pieces(tmp_path / name, rows=rows, limits=limits))
    assert [len(piece.time_s) for piece in pieces[:-1]] == [rows] * (len(pieces) - 1)
    assert 0 < len(pieces[-1].time_s) <= rows
    whole, joined = read_record(tmp_path / name), join_records(pieces)
    assert joined.time_s.tobytes() == whole.time_s.tobytes()
    assert joined.values.tobytes() == whole.values.tobytes()
    assert all(piece.columns == whole.columns for piece in pieces)
    assert all(piece.units == whole.units for piece in pieces)
    assert all(piece.metadata == {"note": "n"} for piece in pieces)


def test_comments_anywhere_in_the_file_apply_to_the_first_piece(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(note="n"), path)
    path.write_text(path.read_text() + "# history: periodic\n# note: m\n")
    first = next(read_pieces(path, rows=10, limits=SMALL))
    assert first.history == "periodic"
    assert first.metadata == read_record(path).metadata == {"note": "n; m", "history": "periodic"}


@pytest.mark.parametrize(
    ("line", "where"),
    [
        ("0.9005,0.02", ":904:x.u: the row has 2 fields"),
        ("0.9005,,1", ":904:x.cmd: the value is missing"),
        ("0.9005,0.02,1_0", ":904:x.u: value '1_0' is not a plain decimal number"),
        ("0.9,0.02,1", ":904:t: time 0.9 s does not increase after 0.9 s"),
        ("0.9005,0.02,1\r2", ":904: a carriage return"),
        ("# mode: fast", ":904:mode: value 'fast'"),
    ],
)
@every_way_to_read
def test_an_error_far_into_the_file_is_the_same_as_for_the_whole_file(
    tmp_path: Path, line: str, where: str, name: str, limits: FileLimits
) -> None:
    path = tmp_path / name
    write_record(make_record(), tmp_path / "plain.csv")
    lines = (tmp_path / "plain.csv").read_text().splitlines()
    lines.insert(903, line)
    text = ("\n".join(lines) + "\n").encode()
    path.write_bytes(gzip.compress(text) if name.endswith(".gz") else text)
    with pytest.raises(RecordError) as whole:
        read_record(path)
    with pytest.raises(RecordError) as in_pieces:
        list(read_pieces(path, rows=100, limits=limits))
    assert str(in_pieces.value) == str(whole.value)
    assert where in str(whole.value)


def test_rows_before_an_error_are_returned(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(), path)
    path.write_text(path.read_text() + "0.5,0,0\n")
    pieces = read_pieces(path, rows=100, limits=SMALL)
    assert [len(next(pieces).time_s) for _ in range(9)] == [100] * 9
    with pytest.raises(RecordError, match=r"a\.csv:1003:t: time"):
        list(pieces)


@pytest.mark.parametrize("text", ["", "t [s],x [m]\n", "# note: n\n", "0,1\n"])
def test_files_that_are_no_record_are_refused_like_whole_files(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text)
    with pytest.raises(RecordError) as whole:
        read_record(path)
    with pytest.raises(RecordError) as in_pieces:
        next(read_pieces(path))
    assert str(in_pieces.value) == str(whole.value)


def test_named_columns_and_the_robot_apply_to_pieces(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(), path, header=False)
    pieces = list(read_pieces(path, columns="t [s], x [m], x.u [V]", rows=300))
    assert join_records(pieces).values.tobytes() == make_record().values.tobytes()
    with pytest.raises(RecordError, match="has no axis 'x'"):
        next(read_pieces(path, columns="t [s], x [m], x.u [V]", robot=load_robot("emps")))


def test_the_limit_on_values_applies_to_each_piece(tmp_path: Path) -> None:
    write_record(make_record(), tmp_path / "a.csv")
    limits = FileLimits(values=100)
    with pytest.raises(RecordError, match="more than 100 values"):
        read_record(tmp_path / "a.csv", limits=limits)
    assert (
        sum(len(piece.time_s) for piece in read_pieces(tmp_path / "a.csv", rows=10, limits=limits))
        == 1000
    )


def cut_record(record: Record, rows: int) -> list[Record]:
    return [
        record.select_rows(slice(start, start + rows))
        for start in range(0, len(record.time_s), rows)
    ]


@pytest.mark.parametrize("rows", [1, 333, 5000])
def test_a_record_that_is_cut_and_joined_is_the_same(rows: int) -> None:
    record = make_record(note="n")
    pieces = cut_record(record, rows)
    assert len(pieces) == -(-1000 // rows)
    joined = join_records(pieces)
    assert joined.time_s.tobytes() == record.time_s.tobytes()
    assert joined.values.tobytes() == record.values.tobytes()
    assert (joined.columns, joined.metadata) == (record.columns, {"note": "n"})


@pytest.mark.parametrize(("name", "header"), [("a.csv", False), ("a.csv.gz", True)])
def test_pieces_are_written_like_the_whole_record(tmp_path: Path, name: str, header: bool) -> None:
    record = make_record(note="n")
    write_record(record, tmp_path / name, units={"x": "um"}, header=header)
    target = tmp_path / f"pieces-{name}"
    write_pieces(cut_record(record, 130), target, units={"x": "um"}, header=header)
    decompress = gzip.decompress if name.endswith(".gz") else bytes
    assert decompress(target.read_bytes()) == decompress((tmp_path / name).read_bytes())


def make_unsuitable_records() -> list[tuple[Record, str]]:
    y = Record.from_signals(np.array([9.0]), {("y", Tap.CMD): np.zeros(1)}, {"y": "m"})
    return [(make_record(), "does not follow"), (y, "has other columns")]


@pytest.mark.parametrize(("second", "message"), make_unsuitable_records(), ids=["time", "columns"])
def test_pieces_that_do_not_follow_each_other_leave_no_file(
    tmp_path: Path, second: Record, message: str
) -> None:
    with pytest.raises(RecordError, match=message):
        write_pieces([make_record(), second], tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(RecordError, match="no rows"):
        write_pieces([], tmp_path / "a.csv")
    with pytest.raises(RecordError, match="does not increase"):
        join_records([make_record(), make_record()])


@pytest.mark.parametrize(
    ("failure", "name"), [(KeyboardInterrupt, "a.csv"), (RecordError, "a.csv.gz")]
)
def test_a_failure_during_writing_keeps_the_old_file(
    tmp_path: Path, failure: type[BaseException], name: str
) -> None:
    def pieces():  # type: ignore[no-untyped-def]
        yield make_record()
        raise failure

    (tmp_path / name).write_text("before")
    with pytest.raises(failure):
        write_pieces(pieces(), tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert (tmp_path / name).read_text() == "before"


def test_selected_rows_keep_the_metadata() -> None:
    part = make_record(note="n").select_rows(slice(10, 20))
    assert part.time_s.tolist() == [row / 1000 for row in range(10, 20)]
    assert part.values.tobytes() == make_record().values[10:20].tobytes()
    assert part.metadata == {"note": "n"}
    with pytest.raises(RecordError, match="no rows"):
        part.select_rows(slice(0, 0))
