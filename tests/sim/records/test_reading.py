import gzip
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.records import FileLimits, RecordChannel, Tap, read_record
from rotemina.sim.robot import Robot, StepperAxis

WriteFile = Callable[..., Path]

TYPICAL_CONTENT = """\
# rotemina-record: 1
# mode: open_loop
t [s],thx.cmd [urad],thx.u [V],thx.ref [urad],thx.meas [urad],zn.cmd [um],zn.meas [um]
0,581.7,65.0,581.6,581.9,32.5,32.51
0.5,582,65.25,582,582,33,33.5
"""


def test_a_typical_record_is_read(write_file: WriteFile, limits: FileLimits) -> None:
    record = read_record(write_file(TYPICAL_CONTENT), limits=limits)
    assert record.time_s.tolist() == [0.0, 0.5]
    assert record.columns[0] == RecordChannel("thx", Tap.CMD)
    assert record.axes == ("thx", "zn")
    assert record.units == {"thx": "rad", "zn": "m"}
    assert record.metadata == {"mode": "open_loop"}
    assert record.signal("thx", Tap.CMD).tolist() == [581.7 / 1e6, 582e-6]
    assert record.signal("thx", Tap.U).tolist() == [65.0, 65.25]
    assert record.signal("zn", Tap.MEAS).tolist() == [32.51 / 1e6, 33.5e-6]


# Each content is read as t = 0, 1.5 s and x = 1, -2.5 mm.
TOLERATED_CONTENTS = {
    "bare axis": b"t [s],x [mm]\n0,1\n1.5,-2.5\n",
    "semicolons": b"t [s];x [mm]\n0;1\n1.5;-2.5\n",
    "semicolons, decimal commas": b"t [s];x [mm]\n0;1\n1,5;-2,5\n",
    "tabs": b"t [s]\tx [mm]\n0\t1\n1.5\t-2.5\n",
    "tabs, decimal commas": b"t [s]\tx [mm]\n0\t1\n1,5\t-2,5\n",
    "blanks": b"t [s] x [mm]\n0 1\n1.5 -2.5\n",
    "runs of blanks and tabs": b"  t [s]    x [mm] \n  0 \t  1\n\t1.5    -2.5  \n",
    "blanks, decimal commas": b"t[s] x[mm]\n0,0 1,0\n1,5 -2,5\n",
    "blanks around fields": b" t [s] ,\t x [ mm ]  \n 0 , 1 \n\t1.5\t,\t-2.5\t\n",
    "blanks around tabs": b"t [s] \t x [mm]\n 0 \t 1 \n 1.5 \t -2.5 \n",
    "CRLF": b"t [s],x [mm]\r\n0,1\r\n1.5,-2.5\r\n",
    "CRLF on some lines": b"t [s],x [mm]\r\n0,1\n1.5,-2.5\r\n",
    "byte-order mark": b"\xef\xbb\xbft [s],x [mm]\n0,1\n1.5,-2.5\n",
    "no last line end": b"t [s],x [mm]\n0,1\n1.5,-2.5",
    "empty lines": b"\n\nt [s],x [mm]\n\n0,1\n  \n\r\n\n1.5,-2.5\n\n\n",
    "signs and exponents": b"t [s],x [mm]\n+0.,+1E0\n.15e+1,-250e-2\n",
    "time in ms": b"t [ms],x [mm]\n0,1\n1500,-2.5\n",
    "time in us": b"t [us],x [mm]\n0,1\n1500000,-2.5\n",
    "micro sign": "t [µs],x [µm]\n0,1000\n1500000,-2500\n".encode(),
    "greek mu": "t [μs],x [μm]\n0,1000\n1500000,-2500\n".encode(),
    "gzip": gzip.compress(b"t [s],x [mm]\n0,1\n1.5,-2.5\n"),
    "gzip in two members": gzip.compress(b"t [s],x [mm]\n0,") + gzip.compress(b"1\n1.5,-2.5\n"),
    "separator line": b"sep=;\r\nt [s];x [mm]\r\n0;1\r\n1,5;-2,5\r\n",
    "quoted separator line": b'"sep=\t"\nt [s]\tx [mm]\n0\t1\n1.5\t-2.5\n',
    "separator line below a mark": b"\xef\xbb\xbfSEP=,\nt [s],x [mm]\n0,1\n1.5,-2.5\n",
    "quoted headings": b'"t [s]","x [mm]"\n0,1\n1.5,-2.5\n',
    "quoted headings, blanks": b'"t [s]" "x [mm]"\n0 1\n1.5 -2.5\n',
    "quoted fields": b'"t [s]";"x [mm]"\n"0";"1"\n"1.5";"-2.5"\n',
    "some quoted fields": b't [s],x [mm]\n0,"1"\n"1.5" , " -2.5 "\n',
    "quoted decimal commas": b'"t [s]","x [mm]"\n"0,0","1,0"\n"1,5","-2,5"\n',
    "separators at the ends": b"t [s];x [mm];\n0;1;\n1.5;-2.5;\n",
    "separators at some ends": b"t [s],x [mm]\n0,1,\n1.5,-2.5\n",
    "a wider table": b"# note,,,\nt [s],x [mm],,\n0,1,,\n1.5,-2.5,,\n",
    "empty rows of a spreadsheet": b",,\n,,\nt [s],x [mm]\n0,1\n1.5,-2.5\n",
    "comments of others": b"% a\n// b\nt [s],x [mm]\n% c\n0,1\n // d\n1.5,-2.5\n",
    "quoted comment": b'"# a, ""b"", c",\nt [s],x [mm]\n0,1\n"# d",\n1.5,-2.5\n',
    "round brackets": b"t (s),x (mm)\n0,1\n1.5,-2.5\n",
    "round brackets, blanks": b"t (s) x (mm)\n0 1\n1.5 -2.5\n",
    "row of units": b"t,x\ns,mm\n0,1\n1.5,-2.5\n",
    "row of units in brackets": b"t;x.cmd\n# a\n[s];(mm)\n0;1\n1.5;-2.5\n",
    "row of units, blanks": b"t x\ns mm\n0 1\n1.5 -2.5\n",
    "units repeated": b"t [s],x [mm]\ns,mm\n0,1\n1.5,-2.5\n",
    "no-break spaces": "t\u00a0[s],x\u202f[mm]\n0,1\n1.5\u00a0,\u00a0-2.5\n".encode(),
    "CR": b"t [s],x [mm]\r0,1\r1.5,-2.5\r",
    "UTF-16": "t [s]\tx [mm]\r\n0\t1\r\n1,5\t-2,5\r\n".encode("utf-16"),
    "UTF-16, big end first": "\ufefft [s],x [mm]\r0,1\r1.5,-2.5".encode("utf-16-be"),
    "compressed UTF-16": gzip.compress("t [s],x [mm]\n0,1\n1.5,-2.5\n".encode("utf-16")),
    "comments anywhere": b"# a\nt [s],x [mm]\n#\n0,1\n  # between\n1.5,-2.5\n# end",
}


@pytest.mark.parametrize("content", TOLERATED_CONTENTS.values(), ids=TOLERATED_CONTENTS.keys())
def test_deviations_from_the_format_are_tolerated(
    content: bytes, write_file: WriteFile, limits: FileLimits
) -> None:
    record = read_record(write_file(content), limits=limits)
    assert record.columns == (("x", Tap.CMD),)
    assert record.time_s.tolist() == [0.0, 1.5]
    assert record.values.tolist() == [[1e-3], [-2.5e-3]]


HEADERLESS_CONTENTS = {
    "commas": b"0,1\n1.5,-2.5\n",
    "semicolons, decimal commas": b"0,0;1,0\n1,5;-2,5\n",
    "tabs, decimal commas": b"0,0\t1\n1,5\t-2,5\n",
    "blanks, decimal commas": b"# paper's\n  0,0   1\n  1,5 -2,5\n",
    "comma and blank": b"0, 1\n1.5, -2.5\n",
    "the header is there": b"t [s],x [mm]\n0,1\n1.5,-2.5\n",
}


@pytest.mark.parametrize("content", HEADERLESS_CONTENTS.values(), ids=HEADERLESS_CONTENTS.keys())
def test_named_columns_choose_the_separator(
    content: bytes, write_file: WriteFile, limits: FileLimits
) -> None:
    record = read_record(write_file(content), columns="t [s], x [mm]", limits=limits)
    assert record.time_s.tolist() == [0.0, 1.5]
    assert record.values.tolist() == [[1e-3], [-2.5e-3]]


def test_the_number_of_columns_resolves_ambiguous_separators(write_file: WriteFile) -> None:
    path = write_file("0,5 1,5 2,5\n")
    record = read_record(path, columns="t [s], x [m], y [m]")
    assert [record.time_s[0], *record.values[0]] == [0.5, 1.5, 2.5]


def test_metadata_are_collected_from_the_whole_file(
    write_file: WriteFile, limits: FileLimits
) -> None:
    content = (
        "#history:periodic\nt [s],x [m]\n#  period_samples :  12 \n0,1\n# note: a: b, c\n"
        "# prose without a key\n#: no key\n1,2\n# empty:\n# note: second\n# rotemina-record: 1\n"
    )
    record = read_record(write_file(content), limits=limits)
    assert record.metadata == {
        "history": "periodic",
        "period_samples": "12",
        "note": "a: b, c; second",
        "empty": "",
    }
    assert record.period_samples == 12


def make_robot() -> Robot:
    free = StepperAxis(kind="stepper", range=(0.0, 1.0), static=True)
    slide = StepperAxis(kind="stepper", range=(0.0, 1.0), unit="m", static=True)
    return Robot(name="bench", axes={"x": slide, "free": free})


def test_a_command_beyond_the_range_is_read(write_file: WriteFile) -> None:
    record = read_record(write_file("t [s],x [m]\n0,-99\n"), robot=make_robot())
    assert record.values.tolist() == [[-99.0]]


@pytest.mark.parametrize("unit", ["m", "rad"])
def test_a_robot_may_leave_the_unit_to_the_record(write_file: WriteFile, unit: str) -> None:
    record = read_record(write_file(f"t [s],free [{unit}]\n0,1\n"), robot=make_robot())
    assert record.units == {"free": unit}


def test_any_axis_name_is_accepted(write_file: WriteFile) -> None:
    names = ("t", "axis 7", "stage.left", "θx", "q_1", "nan", "a-b")
    header = ",".join(["t [s]", *(f"{name}.cmd [m]" for name in names)])
    record = read_record(write_file(f"{header}\n0,1,2,3,4,5,6,7\n"))
    assert record.axes == names


def test_arrays_are_read_only_and_signals_contiguous(write_file: WriteFile) -> None:
    record = read_record(write_file(TYPICAL_CONTENT))
    assert not record.values.flags.writeable
    assert record.signal("thx", Tap.U).flags.c_contiguous


def test_a_reference_record_is_read(shared_dir: Path, limits: FileLimits) -> None:
    if limits.block_bytes < 1000:
        limits = FileLimits(small_block_bytes=0, block_bytes=30_000)
    path = shared_dir / "reference" / "uneven.csv"
    record = read_record(path, limits=limits)
    expected = np.loadtxt(path, delimiter=",", skiprows=4)
    assert record.axes == ("x", "y", "z", "thx", "thy", "zn")
    assert record.time_s.tolist() == expected[:, 0].tolist()
    assert record.values.tolist() == expected[:, 1:].tolist()


def test_a_compressed_example_is_read(shared_dir: Path) -> None:
    path = shared_dir / "examples" / "example_1" / "train_1.csv.gz"
    record = read_record(path)
    with gzip.open(path) as file:
        expected = np.loadtxt(file, delimiter=",", skiprows=3)
    assert record.axes == ("thx", "thy", "zn")
    assert record.has("thx", Tap.REF)
    assert record.time_s.tolist() == expected[:, 0].tolist()
    assert record.signal("zn", Tap.MEAS).tolist() == (expected[:, 12] / 1e6).tolist()
    assert record.signal("thy", Tap.U).tolist() == expected[:, 6].tolist()


def test_a_table_of_another_kind_is_refused(shared_dir: Path) -> None:
    with pytest.raises(ValueError, match=r"kinematics.csv:2:1: .*must be time"):
        read_record(shared_dir / "reference" / "kinematics.csv")


@pytest.mark.parametrize(
    "content",
    [
        b"t [s],x [m]\n0,1000.5\n1,1008.25",
        b"t [s],x [m]\n0,1\n1,125",
        b"t [s],x [m]\n0,1.5\n1,2.5",
    ],
)
def test_a_last_number_that_may_be_truncated_gives_a_warning(
    content: bytes, write_file: WriteFile, limits: FileLimits, caplog: pytest.LogCaptureFixture
) -> None:
    record = read_record(write_file(content), limits=limits)
    assert len(record.time_s) == 2
    assert [entry.levelname for entry in caplog.records] == ["WARNING"]
    assert "run.csv:3: the last line has no line end; if the file was cut off" in caplog.text


@pytest.mark.parametrize(
    "content",
    [
        b"t [s],x [m]\n0,1.50\n1,2.25",
        b"t [s];x [m]\n0;1,50e-03\n1;2,25e-04",
        b"t [s],x [m]\n0,1.5\n1,2.25\n",
        b"t [s],x [m]\n0,1.5\n1,2.25\n# end",
        b"t [s],x [m]\n0,1.5\n1,2.25\n  ",
    ],
)
def test_a_complete_last_number_gives_no_warning(
    content: bytes, write_file: WriteFile, limits: FileLimits, caplog: pytest.LogCaptureFixture
) -> None:
    assert len(read_record(write_file(content), limits=limits).time_s) == 2
    assert not caplog.records


def test_a_warning_contains_no_control_characters(
    write_file: WriteFile, caplog: pytest.LogCaptureFixture
) -> None:
    read_record(write_file("t [s],x [m]\n0,1", "a\nb.csv"))
    assert "a\\nb.csv:2: the last line" in caplog.text


def test_a_file_saved_by_a_spreadsheet_keeps_its_metadata(write_file: WriteFile) -> None:
    content = '# rotemina-record: 1,,\n# mode: open_loop,,\n"# note: a, ""b""",,\n'
    record = read_record(write_file(content + "t [s],x [m],\n0,1,\n"))
    assert record.metadata == {"mode": "open_loop", "note": 'a, "b"'}


def test_an_ambiguous_quoted_number_is_read_with_the_decimal_sign_of_the_file(
    write_file: WriteFile,
) -> None:
    path = write_file('t [s],x [m]\n"0,5","1,234"\n"1,5","2,5"\n')
    assert read_record(path).values.tolist() == [[1.234], [2.5]]
