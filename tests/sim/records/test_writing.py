import gzip
import io
import math
import os
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from hypothesis.extra import numpy as st_numpy

from rotemina.sim.errors import RecordError
from rotemina.sim.records import (
    VOLTAGE_TAPS,
    FileLimits,
    Record,
    Tap,
    read_record,
    write_columns,
    write_record,
)
from rotemina.sim.units import units_of

SAME_FOLDER = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
FAST = FileLimits(small_block_bytes=0)

finite = st.floats(allow_nan=False, allow_infinity=False)
# Within the range of float64 in every unit: 1e290 m is 1e299 nm.
moderate = st.floats(-1e290, 1e290)
names = st.from_regex(r"\A[a-zA-Z_µθ][\w .\-]{0,8}\w\Z", fullmatch=True)
words = st.text(st.characters(exclude_categories=["C"]), max_size=12).map(lambda s: s.strip())
keys = words.filter(lambda key: key and ":" not in key and not key.startswith("#"))
free_keys = keys.filter(
    lambda key: key not in ("mode", "history", "period_samples", "rotemina-record")
)


@st.composite
def records(draw: st.DrawFn, values: st.SearchStrategy[float]) -> Record:
    """Draw a record of any axes, taps, numbers and metadata."""
    columns = []
    units = {}
    for axis in draw(st.lists(names, min_size=1, max_size=3, unique=True)):
        taps = draw(st.lists(st.sampled_from(list(Tap)), unique=True))
        columns += [(axis, tap) for tap in dict.fromkeys([Tap.CMD, *taps])]
        units[axis] = draw(st.sampled_from(["m", "rad"]))
    time_s = sorted(draw(st.lists(finite, min_size=1, max_size=5, unique=True)))
    shape = (len(time_s), len(columns))
    table = draw(st_numpy.arrays(np.float64, shape, elements=values))
    signals = {column: table[:, index] for index, column in enumerate(columns)}
    metadata = draw(st.dictionaries(free_keys, words, max_size=3))
    metadata |= draw(st.sampled_from([{}, {"mode": "closed_loop"}, {"period_samples": "3"}]))
    return Record.from_signals(np.array(time_s), signals, units, metadata)


@SAME_FOLDER
@given(record=records(finite), name=st.sampled_from(["a.csv", "a.csv.gz", "a.txt"]))
def test_si_values_are_restored_bit_for_bit(tmp_path: Path, record: Record, name: str) -> None:
    write_record(record, tmp_path / name)
    for limits in (FileLimits(), FAST):
        restored = read_record(tmp_path / name, limits=limits)
        assert restored.time_s.tobytes() == record.time_s.tobytes()
        assert restored.values.tobytes() == record.values.tobytes()
        assert restored.columns == record.columns
        assert restored.units == record.units
        assert restored.metadata == record.metadata


@SAME_FOLDER
@given(record=records(moderate), data=st.data())
def test_values_in_other_units_are_restored_within_two_ulp(
    tmp_path: Path, record: Record, data: st.DataObject
) -> None:
    units = {axis: data.draw(st.sampled_from(units_of(record.units[axis]))) for axis in record.axes}
    write_record(record, tmp_path / "a.csv", units=units)
    restored = read_record(tmp_path / "a.csv")
    assert restored.columns == record.columns
    assert restored.time_s.tobytes() == record.time_s.tobytes()
    for axis, tap in record.columns:
        pairs = zip(restored.signal(axis, tap), record.signal(axis, tap), strict=True)
        ulps = 0 if tap in VOLTAGE_TAPS else 2
        assert all(abs(new - old) <= ulps * math.ulp(old) for new, old in pairs)


@SAME_FOLDER
@given(record=records(finite))
def test_values_are_restored_without_a_header(tmp_path: Path, record: Record) -> None:
    write_record(record, tmp_path / "a.csv", header=False)
    content = (tmp_path / "a.csv").read_text()
    assert len(content.splitlines()) == len(record.time_s)
    columns = ["t [s]"]
    for axis, tap in record.columns:
        unit = "V" if tap in VOLTAGE_TAPS else record.units[axis]
        columns.append(f"{axis}.{tap} [{unit}]")
    restored = read_record(tmp_path / "a.csv", columns=",".join(columns))
    assert restored.values.tobytes() == record.values.tobytes()
    assert restored.columns == record.columns


def make_record(**metadata: str) -> Record:
    time_s = np.array([0.0, 0.1])
    signals = {("x", Tap.CMD): np.array([0.001, -1e-4]), ("x", Tap.U): np.array([0.5, 1.0])}
    return Record.from_signals(time_s, signals, {"x": "m"}, metadata)


def test_a_written_file_has_the_expected_text(tmp_path: Path) -> None:
    write_record(make_record(mode="open_loop", note="a: b"), tmp_path / "a.csv", units={"x": "um"})
    head, first, second = (tmp_path / "a.csv").read_text().rsplit("\n", 3)[:3]
    assert head == "# rotemina-record: 1\n# mode: open_loop\n# note: a: b\nt [s],x.cmd [um],x.u [V]"
    assert [float(field) for field in first.split(",")] == [0.0, 1000.0, 0.5]
    assert [float(field) for field in second.split(",")] == [0.1, -100.0, 1.0]


def test_columns_are_written_with_the_fewest_digits() -> None:
    numbers = [[0.1, -0.0, 1 / 3], [1234.5, 123456789.0, 5e-324], [math.nan, math.inf, -math.inf]]
    file = io.BytesIO()
    write_columns(file, list(np.array(numbers).T))
    rows = file.getvalue().decode().splitlines()
    assert rows == ["0.1,-0.0,0.3333333333333333", "1234.5,123456789.0,5e-324", "nan,inf,-inf"]


def test_the_version_line_is_written_once(tmp_path: Path) -> None:
    record = make_record(note="n")
    for name in ("a.csv", "b.csv", "c.csv"):
        write_record(record, tmp_path / name)
        record = read_record(tmp_path / name)
    assert (tmp_path / "c.csv").read_bytes() == (tmp_path / "a.csv").read_bytes()
    write_record(make_record(**{"rotemina-record": "1"}), tmp_path / "d.csv")
    assert (tmp_path / "d.csv").read_text().count("rotemina-record") == 1


def test_a_compressed_file_has_the_same_bytes_each_time(tmp_path: Path) -> None:
    write_record(make_record(), tmp_path / "a.csv")
    write_record(make_record(), tmp_path / "a.csv.gz")
    write_record(make_record(), tmp_path / "b.csv.gz")
    compressed = (tmp_path / "a.csv.gz").read_bytes()
    assert gzip.decompress(compressed) == (tmp_path / "a.csv").read_bytes()
    assert compressed == (tmp_path / "b.csv.gz").read_bytes()
    time_stamp = compressed[4:8]
    assert time_stamp == bytes(4)


def test_many_rows_are_written_in_order(tmp_path: Path) -> None:
    time_s = np.arange(150_000) / 1000
    record = Record.from_signals(time_s, {("x", Tap.CMD): np.sin(time_s)}, {"x": "rad"})
    write_record(record, tmp_path / "a.csv")
    restored = read_record(tmp_path / "a.csv")
    assert restored.time_s.tobytes() == time_s.tobytes()
    assert restored.values.tobytes() == record.values.tobytes()


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("a\nb", "c"),
        ("a", "b\nc"),
        ("a", "b\rc"),
        ("a", "b\0c"),
        ("a", " b"),
        ("a", "b\t"),
        (" a", "b"),
        ("", "b"),
        ("a:b", "c"),
        ("a", "\ud800"),
        ("a", "b" * 1_000_000),
        ("mode", "fast"),
        ("history", "rest"),
        ("period_samples", "1.5"),
        ("rotemina-record", "2"),
    ],
)
def test_metadata_that_could_not_be_read_back_are_refused(
    tmp_path: Path, key: str, value: str
) -> None:
    with pytest.raises(RecordError, match="metadata:") as refusal:
        write_record(make_record(**{key: value}), tmp_path / "a.csv")
    assert len(str(refusal.value)) < 300
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "axis",
    ["", "x ", "x" * 101, *(f"{c}x" for c in " [#=@+-"), *(f"x{c}y" for c in ',;"\t\n\x9b')],
)
def test_axis_names_that_could_not_be_read_back_are_refused(tmp_path: Path, axis: str) -> None:
    record = Record.from_signals(np.zeros(1), {(axis, Tap.CMD): np.zeros(1)}, {axis: "m"})
    with pytest.raises(RecordError, match="cannot name an axis"):
        write_record(record, tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []


def test_an_axis_without_command_is_refused(tmp_path: Path) -> None:
    record = Record.from_signals(np.zeros(1), {("x", Tap.MEAS): np.zeros(1)}, {"x": "m"})
    with pytest.raises(RecordError, match=r"axis 'x' has x.meas but no x.cmd"):
        write_record(record, tmp_path / "a.csv")


@pytest.mark.parametrize(
    ("units", "message"),
    [
        ({"y": "mm"}, "units: the record has no axis 'y'; its axes are x"),
        ({"x": "urad"}, "units:x: 'urad' cannot be converted to m"),
        ({"x": "V"}, "units:x: 'V' cannot be converted to m"),
        ({"x": "inch"}, "units:x: unknown unit 'inch'"),
    ],
)
def test_units_that_do_not_fit_are_refused(
    tmp_path: Path, units: dict[str, str], message: str
) -> None:
    with pytest.raises(RecordError, match=re.escape(message)):
        write_record(make_record(), tmp_path / "a.csv", units=units)


def test_a_micro_sign_is_written_as_u(tmp_path: Path) -> None:
    write_record(make_record(), tmp_path / "a.csv", units={"x": "µm"})
    assert "x.cmd [um]" in (tmp_path / "a.csv").read_text()


def test_a_value_too_large_for_its_unit_leaves_no_file(tmp_path: Path) -> None:
    record = Record.from_signals(np.zeros(1), {("x", Tap.CMD): np.full(1, 1e301)}, {"x": "m"})
    with pytest.raises(RecordError, match=r"record:x.cmd: too large for \[nm\]"):
        write_record(record, tmp_path / "a.csv", units={"x": "nm"})
    assert list(tmp_path.iterdir()) == []


def test_a_failed_export_keeps_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(), path)
    old_content = path.read_bytes()

    def fail(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(RecordError, match=r"a.csv cannot be written \(No space left"):
        write_record(make_record(note="new"), path)
    assert path.read_bytes() == old_content
    assert list(tmp_path.iterdir()) == [path]
    monkeypatch.undo()
    write_record(make_record(note="new"), path)
    assert read_record(path).metadata == {"note": "new"}


@pytest.mark.skipif(os.name == "nt", reason="an open file cannot be replaced there")
def test_an_open_reader_continues_with_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write_record(make_record(), path)
    with path.open() as old_file:
        write_record(make_record(note="new"), path)
        assert "new" not in old_file.read()
    assert "new" in path.read_text()


def test_a_path_where_no_file_can_be_written_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordError, match="is a folder"):
        write_record(make_record(), tmp_path)
    with pytest.raises(RecordError, match="cannot be written"):
        write_record(make_record(), tmp_path / "absent" / "a.csv")
    assert list(tmp_path.iterdir()) == []


def test_a_symbolic_link_is_kept(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    link = tmp_path / "a.csv"
    try:
        link.symlink_to(tmp_path / "deep" / "b.csv")
    except OSError:
        pytest.skip("no rights to make links here")
    write_record(make_record(), link)
    assert link.is_symlink()
    assert (tmp_path / "deep" / "b.csv").is_file()
