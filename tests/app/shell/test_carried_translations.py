"""The tool that carries the German over to reworded English loses and invents nothing."""

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


def texts_file(*entries):
    made = "".join(
        ENTRY.format(source=source, german=german, kind="" if german else ' type="unfinished"')
        for source, german in entries
    )
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n'
        '<TS version="2.1" language="de" sourcelanguage="en">\n<context>\n'
        f"    <name>shell</name>\n{made}</context>\n</TS>\n"
    )


@pytest.fixture
def tool(tmp_path, monkeypatch):
    spec = importlib.util.spec_from_file_location("translations", TOOL)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "FOLDER", tmp_path)
    return module


@pytest.fixture
def reworded(tool, tmp_path, monkeypatch):
    """A file whose first English text was reworded since the last commit; the German is gone."""
    before = texts_file(("The header tells what moves", "Der Kopf"), ("Stop", "Halt"))
    now = texts_file(("The header shows what moves", ""), ("Stop", "Halt"))
    (tmp_path / "shell.ts").write_text(now, "utf-8")
    commit = dict(tool.texts("shell.ts", before))
    monkeypatch.setattr(tool, "read_commit", lambda _: commit)
    return tmp_path / "shell.ts"


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_an_open_text_is_listed_with_the_german_of_its_former_wording(tool, reworded, capsys):
    assert tool.main(["open"]) == 0
    (row,) = rows(capsys.readouterr().out)
    assert row["english"] == "The header shows what moves"
    assert row["earlier_german"] == "Der Kopf"
    assert row["german"] == ""


def test_a_filled_table_ends_up_in_the_file_and_nothing_else_changes(tool, reworded, tmp_path):
    table = tmp_path / "table.csv"
    table.write_text(
        "file,context,english,german\nshell.ts,shell,The header shows what moves,Der Kopf zeigt\n",
        "utf-8",
    )
    assert tool.main(["fill", str(table)]) == 0
    wanted = texts_file(("The header shows what moves", "Der Kopf zeigt"), ("Stop", "Halt"))
    assert reworded.read_text("utf-8") == wanted


@pytest.mark.parametrize(
    "row",
    [
        "shell.ts,shell,The header shows what moves,{axis} bewegt sich",
        "shell.ts,shell,A text that is not there,Text",
    ],
)
def test_a_row_that_fits_no_text_is_refused(tool, reworded, tmp_path, capsys, row):
    table = tmp_path / "table.csv"
    table.write_text(f"file,context,english,german\n{row}\n", "utf-8")
    before = reworded.read_text("utf-8")
    assert tool.main(["fill", str(table)]) == 1
    assert "shell.ts" in capsys.readouterr().err
    assert reworded.read_text("utf-8") == before


def test_lost_translations_are_listed(tool, reworded, capsys):
    assert tool.main(["lost"]) == 0
    (row,) = rows(capsys.readouterr().out)
    assert (row["earlier_english"], row["earlier_german"]) == (
        "The header tells what moves",
        "Der Kopf",
    )
