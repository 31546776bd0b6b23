import gzip
from collections.abc import Callable
from pathlib import Path

import pytest

from rotemina.sim.errors import RecordError
from rotemina.sim.records import FileLimits, read_preview

WriteFile = Callable[..., Path]


@pytest.mark.parametrize(
    ("content", "separator", "headings", "first_row"),
    [
        ("# a: b\nt [s], x [mm]\n0,1\n", ",", ("t [s]", "x [mm]"), ("0", "1")),
        ("t [s] x [mm]\n0 1\n", " ", ("t [s]", "x [mm]"), ("0", "1")),
        ("time;pos\n0;1,5\n", ";", ("time", "pos"), ("0", "1,5")),
        ("time pos other\n0 1 2\n", " ", ("time", "pos", "other"), ("0", "1", "2")),
        ('"t","x"\n"0","1,5"\n', ",", ("t", "x"), ("0", "1,5")),
        ("sep=;\nt;x;\n0;1,5;\n", ";", ("t", "x"), ("0", "1,5")),
        ("% a\n;;\n0;1,5;\n1;2,5;\n", ";", (), ("0", "1,5")),
        ('"sep=,"\n"0,5","1,5"\n', ",", (), ("0,5", "1,5")),
        ("0,1,2\n", ",", (), ("0", "1", "2")),
        ("0, 1, 2\n", ",", (), ("0", "1", "2")),
        ("0;1,5;2\n", ";", (), ("0", "1,5", "2")),
        ("0\t1,5\n", "\t", (), ("0", "1,5")),
        ("\n 0,0   1,5\n 1,0   2,5\n", " ", (), ("0,0", "1,5")),
        ("0,5 1\n1 2\n", " ", (), ("0,5", "1")),
        # The first row on its own would also fit a comma.
        ("0, 1\n1, 2,5\n", " ", (), ("0,", "1")),
        ("1.5\n2.5\n", " ", (), ("1.5",)),
    ],
)
def test_separator_and_header_are_recognized(
    content: str,
    separator: str,
    headings: tuple[str, ...],
    first_row: tuple[str, ...],
    write_file: WriteFile,
) -> None:
    preview = read_preview(write_file(content))
    assert (preview.separator, preview.headings, preview.rows[0]) == (
        separator,
        headings,
        first_row,
    )
    assert preview.has_header == bool(headings)
    assert preview.column_count == len(first_row)


def test_only_the_beginning_is_read(tmp_path: Path) -> None:
    path = tmp_path / "long.csv.gz"
    rows = "".join(f"{step},1\n" for step in range(100_000)).encode()
    # The end of the file is damaged, which does not matter for its beginning.
    path.write_bytes(gzip.compress(b"t [s],x [m]\n" + rows)[:-20])
    preview = read_preview(path)
    assert [row[0] for row in preview.rows] == [str(step) for step in range(20)]
    assert len(read_preview(path, rows=3).rows) == 3


def test_odd_rows_are_shown_as_they_are(write_file: WriteFile) -> None:
    preview = read_preview(write_file("t [s],x [m]\n0\n1,2,3\nnan,off\n"))
    assert preview.rows == (("0",), ("1", "2", "3"), ("nan", "off"))


def test_the_fingerprint_depends_on_the_layout_only(write_file: WriteFile) -> None:
    contents = {
        "plain": "0,1,2\n",
        "longer": "5,6,7\n6,7,8\n",
        "wider": "0,1,2,3\n",
        "semicolons": "0;1;2\n",
        "header": "t [s],x [m],y [m]\n0,1,2\n",
        "other header": "t [s],x [m],z [m]\n0,1,2\n",
    }
    fingerprints = {
        name: read_preview(write_file(content, f"{name}.csv")).fingerprint
        for name, content in contents.items()
    }
    assert fingerprints["plain"] == fingerprints["longer"] == "comma:3:no header"
    assert len(set(fingerprints.values())) == 5


def test_files_without_a_preview_are_refused(write_file: WriteFile, tmp_path: Path) -> None:
    with pytest.raises(RecordError, match=r"a.csv: no header and no rows"):
        read_preview(write_file("# comment\n\n", "a.csv"))
    with pytest.raises(RecordError, match="binary or UTF-16"):
        read_preview(write_file(b"\0\1", "b.csv"))
    with pytest.raises(RecordError, match="longer than 10 bytes"):
        read_preview(write_file("0,1234567890\n", "c.csv"), limits=FileLimits(line_bytes=10))
    with pytest.raises(RecordError, match="file not found"):
        read_preview(tmp_path / "absent.csv")
