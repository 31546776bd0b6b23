"""The translation tool lists open texts, fills in a table and reports lost translations."""

import csv
import importlib.util
import io
from pathlib import Path

import pytest

TOOL = Path(__file__).parents[3] / ".ci" / "translations.py"
ENTRY = """    <message>
        <source>{source}</source>
        <translation{kind}>{german}</translation>
    </message>
"""


def make_ts_file(*entries):
    messages = "".join(
        ENTRY.format(source=source, german=german, kind="" if german else ' type="unfinished"')
        for source, german in entries
    )
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n'
        '<TS version="2.1" language="de" sourcelanguage="en">\n<context>\n'
        f"    <name>shell</name>\n{messages}</context>\n</TS>\n"
    )


@pytest.fixture
def tool(tmp_path, monkeypatch):
    spec = importlib.util.spec_from_file_location("translations", TOOL)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "FOLDER", tmp_path)
    return module


@pytest.fixture
def reworded_file(tool, tmp_path, monkeypatch):
    """A file whose first English text was reworded since the last commit and lost its German."""
    before = make_ts_file(("The header tells what moves", "Der Kopf"), ("Stop", "Halt"))
    now = make_ts_file(("The header shows what moves", ""), ("Stop", "Halt"))
    (tmp_path / "shell.ts").write_text(now, "utf-8")
    commit = dict(tool.texts("shell.ts", before))
    monkeypatch.setattr(tool, "read_commit", lambda _: commit)
    return tmp_path / "shell.ts"


def parse_rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_open_and_lost_texts_are_listed_with_their_earlier_german(tool, reworded_file, capsys):
    assert tool.main(["open"]) == 0
    (row,) = parse_rows(capsys.readouterr().out)
    assert row["english"] == "The header shows what moves"
    assert (row["earlier_german"], row["german"]) == ("Der Kopf", "")
    assert tool.main(["lost"]) == 0
    (row,) = parse_rows(capsys.readouterr().out)
    assert row["earlier_english"] == "The header tells what moves"
    assert row["earlier_german"] == "Der Kopf"


def test_filling_in_a_table_changes_nothing_else(tool, reworded_file, tmp_path):
    table = tmp_path / "table.csv"
    table.write_text(
        "file,context,english,german\nshell.ts,shell,The header shows what moves,Der Kopf zeigt\n",
        "utf-8",
    )
    assert tool.main(["fill", str(table)]) == 0
    expected = make_ts_file(("The header shows what moves", "Der Kopf zeigt"), ("Stop", "Halt"))
    assert reworded_file.read_text("utf-8") == expected


@pytest.mark.parametrize(
    "row",
    [
        "shell.ts,shell,The header shows what moves,{axis} bewegt sich",
        "shell.ts,shell,A text that is not there,Text",
    ],
)
def test_a_row_that_matches_no_text_is_rejected(tool, reworded_file, tmp_path, capsys, row):
    table = tmp_path / "table.csv"
    table.write_text(f"file,context,english,german\n{row}\n", "utf-8")
    before = reworded_file.read_text("utf-8")
    assert tool.main(["fill", str(table)]) == 1
    assert "shell.ts" in capsys.readouterr().err
    assert reworded_file.read_text("utf-8") == before
