"""Each refusal names the file, the line, the column and the reason."""

import gzip
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from rotemina.sim.errors import RecordError
from rotemina.sim.records import FileLimits, read_record
from rotemina.sim.robot import Robot, StepperAxis

WriteFile = Callable[..., Path]

HEAD = "# mode: open_loop\nt [s],x.cmd [mm],x.meas [mm]\n0,1,1\n"
GOOD = HEAD + "1,2,2\n"
COMPRESSED = gzip.compress(GOOD.encode(), mtime=0)  # the same bytes in every process

# Content of the file, place in the message (after the file name) and a part of the message.
REFUSED_CONTENTS: dict[str, tuple[str | bytes, str, str]] = {
    "time stands still": (HEAD + "0,2,2\n", ":4:t", "time 0.0 s does not increase after 0.0 s"),
    "time goes back": (GOOD + "0.5,2,2\n", ":5:t", "time 0.5 s does not increase after 1.0 s"),
    "empty value": (HEAD + "1,,2\n", ":4:x.cmd", "value is missing"),
    "empty last value": (HEAD + "1,2,\n", ":4:x.meas", "value is missing"),
    "empty time": (HEAD + ",2,2\n", ":4:t", "value is missing"),
    "only separators": (HEAD + ",,\n", ":4:t", "value is missing"),
    "blank value": (HEAD + "1, ,2\n", ":4:x.cmd", "value is missing"),
    "nan": (HEAD + "1,2,nan\n", ":4:x.meas", "value 'nan' is not finite"),
    "NaN": (HEAD + "1,NaN,2\n", ":4:x.cmd", "value 'NaN' is not finite"),
    "inf": (HEAD + "1,-inf,2\n", ":4:x.cmd", "value '-inf' is not finite"),
    "infinity": (HEAD + "1,Infinity,2\n", ":4:x.cmd", "value 'Infinity' is not finite"),
    "overflow": (HEAD + "1,1e400,2\n", ":4:x.cmd", "value '1e400' exceeds"),
    "underscore": (HEAD + "1,1_000,2\n", ":4:x.cmd", "value '1_000' is not a plain decimal"),
    "hexadecimal": (HEAD + "1,0x10,2\n", ":4:x.cmd", "value '0x10' is not a plain decimal"),
    "blank in a number": (HEAD + "1,1 234,2\n", ":4:x.cmd", "'1 234' has a thousands separator"),
    "no-break space": (HEAD + "1,1\u00a0234,2\n", ":4:x.cmd", "has a thousands separator"),
    "apostrophe": (HEAD + "1,1'234.5,2\n", ":4:x.cmd", '234.5" has a thousands separator'),
    "quoted thousands": (HEAD + '1,"1,234",2\n', ":4:x.cmd", "'1,234' has a thousands separator"),
    "millions": (HEAD + '1,"1,234,567.5",2\n', ":4:x.cmd", "has a thousands separator; remove it"),
    "signs mixed in quotes": (
        HEAD + '1,2.5,2\n2,"3,5",2\n',
        ":5:x.cmd",
        "value '3,5' has ',' where the numbers before have '.'",
    ),
    "quote left open": (HEAD + '1,"2,2\n', ":4:x.cmd", "has an unpaired quote"),
    "quote inside": (HEAD + '1,2"5,2\n', ":4:x.cmd", "has an unpaired quote"),
    "line end in quotes": ('t [s],"x\n[m]"\n0,1\n', ":1:2", "has an unpaired quote"),
    "empty quotes": (HEAD + '1,"",2\n', ":4:x.cmd", "value is missing"),
    "spreadsheet error": (HEAD + "1,#N/A,2\n", ":4:x.cmd", "'#N/A' is a spreadsheet's mark"),
    "division by zero": (HEAD + "1,#DIV/0!,2\n", ":4:x.cmd", "'#DIV/0!' is a spreadsheet's mark"),
    "time is an error": (HEAD + "#N/A,2,2\n2,2,2\n", ":4", "the row begins with a spreadsheet's"),
    "header again": (HEAD + "t [s],x.cmd [mm],x.meas [mm]\n0,1,1\n", ":4", "a second header; the"),
    "another header": (
        HEAD + "t [s],y [mm]\n0,1\n",
        ":4",
        "a second header; the file contains two",
    ),
    "quoted header again": (HEAD + '"t [s]","x [mm]"\n0,1\n', ":4", "a second header; the file"),
    "unsupported separator": ("sep=|\nt [s]|x [m]\n0|1\n", ":1", "line states the separator '|'"),
    "wrong separator": (
        "sep=;\nt [s],x [m]\n0,1\n",
        ":2",
        "states the separator ';', but",
    ),
    "units below contradict": ("t [s],x [m]\ns,mm\n0,1\n", ":2:t", "value 's' is not a plain"),
    "preamble": ("Logger 7\nt [s],x [m]\n0,1\n", ":1:1", "begin lines above the header with '#'"),
    "zero tail": (GOOD.encode() + bytes(5000), ":5", "delete everything after line 4, the last"),
    "zero tail in a row": (
        GOOD.encode() + b"2,3" + bytes(9),
        ":5",
        "delete everything after line 4, the last",
    ),
    "all zeros": (bytes(5000), "", "contains only zero bytes"),
    "zeros in UTF-16": (
        GOOD.encode("utf-16") + bytes(50),
        ":5",
        "delete everything after line 4, the last",
    ),
    "zeros inside": (GOOD.encode() + bytes(50) + b"2,3,3\n", ":5", "binary or UTF-16"),
    "cut in an exponent": (
        HEAD + "1,2,1.2e-",
        ":4",
        "the file ends inside this line, at '1,2,1.2e-'",
    ),
    "cut after a sign": (HEAD + "1,2,-", ":4", "the file ends inside this line, at '1,2,-'"),
    "cut after a separator": (HEAD + "1,2,", ":4", "the file ends inside this line, at '1,2,'"),
    "cut in quotes": (HEAD + '1,"2","3', ":4", "the file ends inside this line, at"),
    "cut in padded decimals": (
        "t [s],x [m]\n1,1.000\n2,1.250\n3,1.5",
        ":4",
        "the last number '1.5' has fewer digits than all above it",
    ),
    "cut in padded exponents": (
        "t [s],x [m]\n0,1.20e-05\n1,1.50e-0",
        ":3",
        "the last number '1.50e-0' has fewer digits",
    ),
    "our file without its end": (
        "# rotemina-record: 1\n" + GOOD[:-1],
        ":5",
        "no line end, but this program always writes one",
    ),
    "other digits": (HEAD + "1,\uff11,2\n", ":4:x.cmd", "is not a plain decimal"),
    "Fortran exponent": (HEAD + "1,2d3,2\n", ":4:x.cmd", "value '2d3' is not a plain decimal"),
    "formula": (HEAD + "1,=1+1,2\n", ":4:x.cmd", "value '=1+1' is not a plain decimal"),
    "text": (HEAD + "1,off,2\n", ":4:x.cmd", "value 'off' is not a plain decimal"),
    "long text": (HEAD + f"1,{'9' * 3000},2\n", ":4:x.cmd", "999' (3002 characters) exceeds"),
    "comment after numbers": (HEAD + "1,2,2 # why\n", ":4:x.meas", "'2 # why' is not a plain"),
    "row too short": (HEAD + "1,2\n2,3,3\n", ":4:x.meas", "the row has 2 fields where the header"),
    "cut off": (HEAD + "1,2", ":4", "the file ends inside this line, at '1,2': it was cut off"),
    "row too long": (HEAD + "1,2,3,4,5,6,7,8\n", ":4:4", "the row has 8 fields"),
    "first row too long": ("t [s],x [m]\n0,1,2\n", ":2:3", "the row has 3 fields"),
    "decimal commas": (HEAD + "1,0,2,0,2,0\n", ":4:4", "if the commas are decimal signs, sep"),
    "other separator": (HEAD + "1;2;2\n", ":4:x.cmd", "the row has 1 fields"),
    "two decimal signs": (
        "t [s];x [m]\n0;0.5\n1;1,234\n",
        ":3:x.cmd",
        "value '1,234' has ',' where the numbers before have '.'",
    ),
    "thousands": ("t [s];x [m]\n0;1.234,5\n", ":2:x.cmd", "value '1.234,5'"),
    "two commas": ("t [s];x [m]\n0;1,234,5\n", ":2:x.cmd", "'1,234,5' has a thousands separator"),
    "row of tabs": ("t [s]\tx [m]\n0\t1\n\t\n", ":3:t", "value is missing"),
    "stray tab": ("t [s]\tx [m]\n0\t\t1\n", ":2:3", "the row has 3 fields"),
    "no header": ("0,1,2\n", ":1:1", "no header row; name its columns, such as 't [s], x [mm]"),
    "header without time": ("x [m],y [m]\n0,1\n", ":1:1", "the first column, and only it, must"),
    "time again": ("t [s],x [m],t [s]\n0,1,2\n", ":1:3", "the first column, and only it, must"),
    "time alone": ("t [s]\n0\n", ":1", "no column except time"),
    "no unit": ("t [s],x\n0,1\n", ":1:2", "heading 'x' is not 'axis.channel [unit]'"),
    "text after the unit": ("t [s],x [m] y\n0,1\n", ":1:2", "is not 'axis.channel [unit]'"),
    "column without heading": ("t [s],x [m],\n0,1,2\n", ":2:3", "the row has 3 fields"),
    "empty heading": ("t [s],,x [m]\n0,1,2\n", ":1:2", "heading '' is no"),
    "no axis": ("t [s],.cmd [m]\n0,1\n", ":1:2", "'' cannot name an axis"),
    "axis is a formula": ("t [s],=x [m]\n0,1\n", ":1:2", "'=x' cannot name an axis"),
    "unknown unit": ("t [s],x [furlong]\n0,1\n", ":1:2", "unknown unit 'furlong'; use one of m"),
    "unknown time unit": ("t [min],x [m]\n0,1\n", ":1:1", "unknown unit 'min'"),
    "time in m": ("t [m],x [m]\n0,1\n", ":1:1", "t cannot be in [m]; use a unit of s"),
    "position in V": (
        "t [s],x.meas [V]\n0,1\n",
        ":1:2",
        "x.meas cannot be in [V]; use a unit of m",
    ),
    "voltage in m": ("t [s],x.u [m]\n0,1\n", ":1:2", "x.u cannot be in [m]; use a unit of V"),
    "m and rad": ("t [s],x [m],x.ref [rad]\n0,1,1\n", ":1:3", "x.ref is in [rad], but an earlier"),
    "unknown channel": ("t [s],x.mes [m]\n0,1\n", ":1:2", "unknown channel 'mes' in 'x.mes'; use"),
    "column twice": ("t [s],x [m],x.cmd [um]\n0,1,1\n", ":1:3", "x.cmd is already column 2"),
    "no command": ("t [s],x.meas [m]\n0,1\n", ":1", "has x.meas but no x.cmd; add it"),
    "header alone": ("t [s],x [m]\n", ":2", "no rows of numbers"),
    "header and comments": ("t [s],x [m]\n\n# end\n", ":2", "no rows of numbers"),
    "comments alone": ("# mode: open_loop\n", ":1", "no header and no rows"),
    "empty": ("", "", "the file is empty"),
    "empty gzip": (gzip.compress(b"", mtime=0), "", "the file is empty"),
    "Latin-1": (HEAD.encode() + b"1,\xb5,2\n", ":4:byte 3", "is not UTF-8"),
    "Latin-1 header": ("t [s],x [µm]\n0,1\n".encode("latin-1"), ":1:byte 10", "is not UTF-8"),
    "Latin-1 comment": (GOOD.encode() + b"# \xb5\n", ":5:byte 3", "is not UTF-8"),
    "UTF-16 without its mark": (GOOD.encode("utf-16-le"), ":1", "binary or UTF-16"),
    "binary": (GOOD.encode() + b"\x7fELF\x00\x01", ":5", "binary or UTF-16"),
    "gzip in gzip": (gzip.compress(COMPRESSED, mtime=0), "", ""),
    "CR in a row": (HEAD + "1,2\r,2\n", ":4", "end lines with LF or CRLF"),
    "CR twice": (HEAD + "1,2,2\r\r\n", ":4", "end lines with LF or CRLF"),
    "later version": ("# rotemina-record: 2\n" + GOOD, ":1:rotemina-record", "version must be 1"),
    "mode": ("# mode: open\n" + GOOD, ":1:mode", "value 'open'; use open_loop or closed_loop"),
    "mode twice": (GOOD + "# mode: closed_loop\n", ":5:mode", "'closed_loop' contradicts 'open_l"),
    "history": (GOOD + "# history: rest\n", ":5:history", "value 'rest'; use unknown or periodic"),
    "after comments": ("# a: b\n# c\n\n# d\n# mode: x\n" + GOOD, ":5:mode", "value 'x'"),
    "period 0": (GOOD + "# period_samples: 0\n", ":5:period_samples", "value '0'; use a positive"),
    "period -5": (GOOD + "#period_samples:-5\n", ":5:period_samples", "value '-5'"),
    "period 2.5": (GOOD + "#period_samples: 2.5\n", ":5:period_samples", "value '2.5'"),
    "period 1_0": (GOOD + "#period_samples: 1_0\n", ":5:period_samples", "value '1_0'"),
}


@pytest.mark.parametrize(
    ("content", "where", "expected"), REFUSED_CONTENTS.values(), ids=REFUSED_CONTENTS.keys()
)
def test_invalid_contents_are_refused_with_their_place(
    content: str | bytes, where: str, expected: str, write_file: WriteFile, limits: FileLimits
) -> None:
    path = write_file(content)
    with pytest.raises(RecordError) as refusal:
        read_record(path, limits=limits)
    message = str(refusal.value)
    assert message.startswith(f"{path}{where}: " if expected else str(path)), message
    assert expected in message
    assert len(message) < 400 + len(str(path))


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (COMPRESSED[:-9], "the compressed file ends early, after this line"),
        (COMPRESSED[:30], "the compressed file ends early, after this line"),
        (COMPRESSED[:-8] + bytes(8), "the compressed data are damaged after this line"),
        (COMPRESSED + b"more", "the compressed data are damaged after this line"),
        (
            gzip.compress(GOOD.encode("utf-16")[:-1], mtime=0),
            "the UTF-16 text is damaged or cut off after",
        ),
    ],
)
def test_a_damaged_compressed_file_is_refused(
    content: bytes, expected: str, write_file: WriteFile, limits: FileLimits
) -> None:
    path = write_file(content, "run.csv.gz")
    with pytest.raises(RecordError, match=rf"{re.escape(str(path))}:[1-5]: {expected}"):
        read_record(path, limits=limits)


ROBOT = Robot(
    name="bench", axes={"x": StepperAxis(kind="stepper", range=(0.0, 1.0), unit="m", static=True)}
)


@pytest.mark.parametrize(
    ("header", "where", "expected"),
    [
        ("t [s],y [mm]", ":1:2", "robot 'bench' has no axis 'y'; its axes are x"),
        ("t [s],x [urad]", ":1:2", "x.cmd is in [urad] but robot 'bench' moves 'x' in units of m"),
        ("t [s],x [mm],q.cmd [m]", ":1:3", "has no axis 'q'"),
    ],
)
def test_columns_that_do_not_fit_the_robot_are_refused(
    header: str, where: str, expected: str, write_file: WriteFile
) -> None:
    path = write_file(f"{header}\n")
    with pytest.raises(RecordError, match=re.escape(f"{path}{where}: ")) as refusal:
        read_record(path, robot=ROBOT)
    assert expected in str(refusal.value)


@pytest.mark.parametrize(
    ("content", "columns", "message"),
    [
        ("0,1\n", "t [s], x [mile]", "columns:2: 'x': unknown unit 'mile'"),
        ("0,1\n", "t [s], y [m]", "columns:2: robot 'bench' has no axis 'y'"),
        ("0,1\n", "", "columns:1: heading '' is no"),
        ("0,1\n1,2,3\n", "t [s], x [m]", "run.csv:2:3: the row has 3 fields"),
        ("0,1,2\n", "t [s], x [m]", "run.csv:1:3: the row has 3 fields"),
        ("0,1\n", "t [s], x [m], x.u [V]", "run.csv:1:x.u: the row has 2 fields"),
        ("0,off\n", "t [s], x [m]", "run.csv:1:x.cmd: value 'off'"),
        ("nan,1\n", "t [s], x [m]", "run.csv:1:t: value 'nan' is not finite"),
        ("0 1 2\n", "t [s], x [m]", "run.csv:1:3: the row has 3 fields"),
        ("t [s],x [mm]\n0,1\n", "t [s], x [m]", "run.csv:1:2: the header has 'x.cmd [mm]', but"),
        ("t [s],x [m]\n0,1\n", "t [s], x [m], x.u [V]", "run.csv:1:3: the header has no column"),
        ("time,pos\n0,1\n", "t [s], x [m]", "run.csv:1:1: heading 'time' is no"),
    ],
)
def test_named_columns_that_do_not_fit_are_refused(
    content: str, columns: str, message: str, write_file: WriteFile, limits: FileLimits
) -> None:
    path = write_file(content)
    with pytest.raises(RecordError) as refusal:
        read_record(path, columns=columns, robot=ROBOT, limits=limits)
    assert message in str(refusal.value)


def test_the_line_number_counts_comments_and_empty_lines(
    write_file: WriteFile, limits: FileLimits
) -> None:
    rows = "".join(f"{second},1,1\n# c{second}: x\n\r\n" for second in range(1, 40))
    path = write_file(HEAD + rows + "99,1,oops\n")
    with pytest.raises(RecordError, match=f"{re.escape(str(path))}:121:x.meas: value 'oops'"):
        read_record(path, limits=limits)


def test_paths_that_are_no_readable_file_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(RecordError, match=r"absent.csv cannot be read \(file not found"):
        read_record(tmp_path / "absent.csv")
    with pytest.raises(RecordError, match="a folder"):
        read_record(tmp_path)
    with pytest.raises(RecordError, match="a pipe or a device"):
        read_record("/dev/null")
    with pytest.raises(RecordError, match="cannot be read"):
        read_record("nul\0byte")

    def refuse(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    path = tmp_path / "locked.csv"
    path.write_text(GOOD)
    monkeypatch.setattr("os.open", refuse)
    with pytest.raises(RecordError, match=r"locked.csv cannot be read \(Permission denied\)"):
        read_record(path)
