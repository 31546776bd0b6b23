"""Records in pieces: the same as at once, and as strict, far into the file as well."""

import gzip
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.records.file_blocks import Limits
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, RecordError, Tap
from rotemina.sim.records.record_pieces import join_records, read_pieces
from rotemina.sim.records.writing import write_pieces, write_record
from rotemina.sim.robot.file import load_robot

# Blocks of a line or two, and of many: what stands in one block must not matter to the next.
SMALL, FAST = Limits(small_block_bytes=0, block_bytes=50), Limits(small_block_bytes=0)


def make_record(rows: int = 1000, since_s: float = 0.0, **metadata: str) -> Record:
    time_s = since_s + np.arange(rows) / 1000
    signals = {("x", Tap.CMD): 0.02 + np.sin(time_s) / 3000, ("x", Tap.U): np.cos(7 * time_s)}
    return Record.from_signals(time_s, signals, {"x": "m"}, metadata)


@pytest.mark.parametrize("limits", [Limits(), FAST, SMALL], ids=["strict", "fast", "small blocks"])
@pytest.mark.parametrize("name", ["a.csv", "a.csv.gz"])
@pytest.mark.parametrize("rows", [1, 7, 333, 500, 1000, 5000])
def test_pieces_are_the_record_bit_by_bit(
    tmp_path: Path, rows: int, name: str, limits: Limits
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


def test_a_comment_counts_from_the_first_piece_wherever_it_stands(tmp_path: Path) -> None:
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
@pytest.mark.parametrize("limits", [Limits(), FAST, SMALL], ids=["strict", "fast", "small blocks"])
@pytest.mark.parametrize("packed", [False, True])
def test_a_refusal_far_into_the_file_is_that_of_the_whole(
    tmp_path: Path, line: str, where: str, limits: Limits, packed: bool
) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(), path)
    lines = path.read_text().splitlines()
    lines.insert(903, line)
    text = ("\n".join(lines) + "\n").encode()
    path.write_bytes(gzip.compress(text) if packed else text)
    with pytest.raises(RecordError) as whole:
        read_record(path)
    with pytest.raises(RecordError) as in_pieces:
        list(read_pieces(path, rows=100, limits=limits))
    assert str(in_pieces.value) == str(whole.value)
    assert where in str(whole.value)


def test_rows_before_a_refusal_have_been_given(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(), path)
    path.write_text(path.read_text() + "0.5,0,0\n")
    pieces = read_pieces(path, rows=100, limits=SMALL)
    assert [len(next(pieces).time_s) for _ in range(9)] == [100] * 9
    with pytest.raises(RecordError, match=r"a\.csv:1003:t: time"):
        list(pieces)


@pytest.mark.parametrize("text", ["", "t [s],x [m]\n", "# note: n\n", "0,1\n"])
def test_what_is_no_record_is_refused_as_ever(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text)
    with pytest.raises(RecordError) as whole:
        read_record(path)
    with pytest.raises(RecordError) as in_pieces:
        next(read_pieces(path))
    assert str(in_pieces.value) == str(whole.value)


def test_named_columns_and_the_robot_hold_for_pieces(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(), path, header=False)
    pieces = list(read_pieces(path, columns="t [s], x [m], x.u [V]", rows=300))
    assert join_records(pieces).values.tobytes() == make_record().values.tobytes()
    with pytest.raises(RecordError, match="has no axis 'x'"):
        next(read_pieces(path, columns="t [s], x [m], x.u [V]", robot=load_robot("emps")))


def test_the_bound_on_numbers_is_one_on_memory(tmp_path: Path) -> None:
    write_record(make_record(), tmp_path / "a.csv")
    few = Limits(values=100)
    with pytest.raises(RecordError, match="more than 100 values"):
        read_record(tmp_path / "a.csv", limits=few)
    assert sum(len(p.time_s) for p in read_pieces(tmp_path / "a.csv", rows=10, limits=few)) == 1000


def cut(record: Record, rows: int) -> list[Record]:
    return [record.part(slice(at, at + rows)) for at in range(0, len(record.time_s), rows)]


@pytest.mark.parametrize("rows", [1, 333, 1000, 5000])
def test_a_record_is_cut_and_joined(rows: int) -> None:
    record = make_record(note="n")
    pieces = cut(record, rows)
    assert len(pieces) == -(-1000 // rows)
    joined = join_records(pieces)
    assert joined.time_s.tobytes() == record.time_s.tobytes()
    assert joined.values.tobytes() == record.values.tobytes()
    assert (joined.columns, joined.metadata) == (record.columns, {"note": "n"})


@pytest.mark.parametrize("name", ["a.csv", "a.csv.gz"])
@pytest.mark.parametrize("header", [True, False])
def test_pieces_are_written_as_the_whole_is(tmp_path: Path, name: str, header: bool) -> None:
    record = make_record(note="n")
    write_record(record, tmp_path / name, units={"x": "um"}, header=header)
    target = tmp_path / f"pieces-{name}"
    write_pieces(cut(record, 130), target, units={"x": "um"}, header=header)
    read = gzip.decompress if name.endswith(".gz") else bytes
    assert read(target.read_bytes()) == read((tmp_path / name).read_bytes())


def others() -> list[tuple[Record, str]]:
    y = Record.from_signals(np.array([9.0]), {("y", Tap.CMD): np.zeros(1)}, {"y": "m"})
    return [(make_record(), "does not follow"), (y, "has other columns")]


@pytest.mark.parametrize(("second", "message"), others(), ids=["time", "columns"])
def test_pieces_that_do_not_go_on_leave_no_file(
    tmp_path: Path, second: Record, message: str
) -> None:
    with pytest.raises(RecordError, match=message):
        write_pieces([make_record(), second], tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(RecordError, match="no rows"):
        write_pieces([], tmp_path / "a.csv")
    with pytest.raises(RecordError, match="does not increase"):
        join_records([make_record(), make_record()])


@pytest.mark.parametrize("failure", [KeyboardInterrupt, RecordError])
@pytest.mark.parametrize("name", ["a.csv", "a.csv.gz"])
def test_a_piece_that_does_not_come_leaves_what_was_there(
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


def test_a_part_keeps_what_the_record_says() -> None:
    part = make_record(note="n").part(slice(10, 20))
    assert part.time_s.tolist() == [row / 1000 for row in range(10, 20)]
    assert part.values.tobytes() == make_record().values[10:20].tobytes()
    assert part.metadata == {"note": "n"}
    with pytest.raises(RecordError, match="no rows"):
        part.part(slice(0, 0))
