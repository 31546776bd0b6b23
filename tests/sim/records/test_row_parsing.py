"""The fast parser gives the same results as the strict one."""

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import RecordError
from rotemina.sim.records import fast_rows, parse_columns
from rotemina.sim.records.fields import SEPARATORS
from rotemina.sim.records.file_blocks import LineBlock
from rotemina.sim.records.layout import FileLayout
from rotemina.sim.records.row_parsing import RowParser

COLUMNS = parse_columns("t [ms], x [um], x.u [V]", "columns")


def parse_blocks(parse: Callable[[LineBlock], object], blocks: list[LineBlock]) -> object:
    """Return the values of all rows, or the error message."""
    try:
        return [getattr(parse(block), "tolist", list)() for block in blocks]
    except RecordError as error:
        return str(error)


def parse_both_ways(blocks: list[LineBlock], separator: str) -> tuple[object, object]:
    layout = FileLayout(separator, COLUMNS)
    fast = RowParser("run.csv", layout, small_block_bytes=0)
    strict = RowParser("run.csv", layout, small_block_bytes=10**9)
    return parse_blocks(fast.parse, blocks), parse_blocks(strict.parse, blocks)


def make_blocks(lines: list[str], cut: int) -> list[LineBlock]:
    parts = [lines[:cut], lines[cut:]]
    blocks = []
    first_line = 3
    for part in parts:
        data = "".join(line + "\n" for line in part).encode("utf-8", "surrogateescape")
        blocks.append(LineBlock(first_line, data))
        first_line += len(part)
    return blocks


numbers = st.one_of(
    st.floats(-1e6, 1e6).map(repr),
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
    st.decimals(-1000, 1000, places=4).map(str),
    st.from_regex(r"\A[+-]?[0-9]{1,25}\.?[0-9]{0,25}([eE][+-]?[0-9]{1,3})?\Z"),
)
ODDITIES = (
    '.|nan|inf|-Infinity|1_0|0x1|1 2|"1"|1e|+|--1|1e5.0|1d3|1,5|1.5|1,2,3|1.2.3|null|true|#|'
    "\u00a01|\uff11|\udcff|1\r|\f1|.5|5.|+5|-0|-0.0|1E5|1e400|1e-400|5e-324|00012|\v|1\x1c|"
    '"|"1|1"|""|"1,5"|"1 "|"1"2|""1""|"1;2"|#N/A|%1|//|t [s]|1,234|"1,234"|'
)
oddities = st.sampled_from(ODDITIES.split("|"))
blanks = st.sampled_from(["", "", "", " ", "\t", "  "])
ends = st.sampled_from(["", "", "", "\r", " ", "\t", " \r"])


@st.composite
def fields(draw: st.DrawFn, content: st.SearchStrategy[str], comma: bool) -> str:
    text = draw(content)
    text = text.replace(".", ",") if comma else text
    text = f'"{text}"' if draw(st.integers(0, 4)) == 0 else text
    return draw(blanks) + text + draw(blanks)


@st.composite
def files(draw: st.DrawFn, odd: bool) -> tuple[list[str], str]:
    """Draw rows of a rising time and two channels; with oddities in between if ``odd``."""
    separator = draw(st.sampled_from(SEPARATORS))
    comma = separator != "," and draw(st.booleans())
    lines = []
    for step in range(draw(st.integers(1, 6))):
        content = st.one_of(numbers, oddities) if odd and draw(st.booleans()) else numbers
        count = draw(st.sampled_from([2, 2, 2, 2, 1, 3])) if odd else 2
        time = draw(oddities) if odd and draw(st.integers(0, 9)) == 0 else f"{step}.25"
        time = time.replace(".", ",") if comma else time
        row = [time, *(draw(fields(content, comma)) for _ in range(count))]
        fillers = separator * draw(st.sampled_from([0, 0, 0, 1, 3]))
        lines.append(draw(blanks) + separator.join(row) + fillers + draw(ends))
        lines.extend(draw(st.sampled_from([[], [], [], [""], ["# note: 1.5,2"], ["  \r"]])))
    return lines, separator


@given(files(odd=False), st.integers(0, 8))
def test_well_formed_rows_are_parsed_the_same(file: tuple[list[str], str], cut: int) -> None:
    lines, separator = file
    fast, strict = parse_both_ways(make_blocks(lines, cut), separator)
    assert repr(fast) == repr(strict)


@given(files(odd=True), st.integers(0, 8))
def test_odd_rows_give_the_same_result_or_error(file: tuple[list[str], str], cut: int) -> None:
    lines, separator = file
    fast, strict = parse_both_ways(make_blocks(lines, cut), separator)
    assert repr(fast) == repr(strict)


@given(st.binary(max_size=60).map(lambda data: data.replace(b"\n", b"")), st.integers(0, 3))
def test_arbitrary_bytes_give_the_same_result_or_error(junk: bytes, position: int) -> None:
    row = bytearray(b"1,2,3")
    row[position:position] = junk
    fast, strict = parse_both_ways([LineBlock(1, b"0,0,0\n" + bytes(row) + b"\n5,6,7\n")], ",")
    assert repr(fast) == repr(strict)


@given(numbers)
def test_decimal_numbers_are_rounded_like_in_python(text: str) -> None:
    parsed = fast_rows.parse(f"0,{text}\n".encode(), 1, ",", 2)
    value = float(text)
    if abs(value) == float("inf"):
        assert parsed is None
    else:
        assert parsed is not None
        assert parsed[0, 1].tobytes() == parsed.dtype.type(value).tobytes()


@pytest.mark.parametrize(
    ("rows", "separator"),
    [
        ("0,1,2\n1,2,3\n", ","),
        ("0 , 1,\t2\r\n\r\n# c\n1,2,3\r\n", ","),
        ("0,1,2\n# c\n1,2,3\n  # d: 1,5\n", ","),
        ("0;1,5;2\n1;2,5;3\n", ";"),
        ("  0   1\t2\n 1  2    3 \n", " "),
        ("\n\n0 \t 1\t2\n\n\n\n\n1\t2\t3\n", "\t"),
        ('"0";"1,5"; "2"\n1;"2,5";3\r\n', ";"),
        ("0;1;2;\n1;2;3;\n", ";"),
        ("% c\n0,1,2,,\n// d\n\n1,2,3\n", ","),
    ],
)
def test_the_fast_parser_handles_common_deviations(
    rows: str, separator: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("the strict parser was used")

    monkeypatch.setattr(RowParser, "parse_strictly", refuse)
    parser = RowParser("run.csv", FileLayout(separator, COLUMNS), small_block_bytes=0)
    assert len(parser.parse(LineBlock(1, rows.encode()))) > 0


def test_small_blocks_are_parsed_without_pyarrow(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("pyarrow was used")

    monkeypatch.setattr(fast_rows, "parse", refuse)
    parser = RowParser("run.csv", FileLayout(",", COLUMNS))
    assert parser.parse(LineBlock(1, b"0,1,2\n")).tolist() == [[0.0, 1e-6, 2.0]]


@pytest.mark.parametrize(
    ("first", "second", "separator", "message"),
    [
        (b"0,0,0\n", b"\xef\xbb\xbf1,0,0\n", ",", "t: value '\\ufeff1'"),
        (b"5,0,0\n", b"5,0,0\n", ",", "t: time 0.005 s does not increase after 0.005 s"),
        (b"0;0,5;0\n", b"1;0.5;0\n", ";", "x.cmd: value '0.5' has '.'"),
    ],
    ids=["byte-order mark", "time", "decimal sign"],
)
def test_rules_apply_across_blocks(
    first: bytes, second: bytes, separator: str, message: str
) -> None:
    fast, strict = parse_both_ways([LineBlock(1, first), LineBlock(2, second)], separator)
    assert fast == strict
    assert str(fast).startswith(f"run.csv:2:{message}")


def test_invalid_named_columns_are_refused_without_a_file(tmp_path: Path) -> None:
    with pytest.raises(RecordError, match="columns:2: heading 'x' is no"):
        parse_columns("t [s], x", "columns")
