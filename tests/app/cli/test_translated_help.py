"""The help of the command line in German: complete, current, and with the same values in it."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from rotemina.app.cli import language
from rotemina.app.cli.main import build_parser, main
from rotemina.app.cli.translated_help import translate_argparse, translate_parser

FILE = Path(__file__).parents[3] / "resources" / "languages" / "de" / "help.ts"
VALUE = re.compile(r"%\(\w+\)\w|%[srdg%]")
IDS = re.compile(r"[a-z-]+(, [a-z-]+)*")  # names that the reader types
# What argparse says itself, besides what the parsers show.
ERRORS = (
    "usage: ",
    "%(prog)s: error: %(message)s\n",
    "argument %(argument_name)s: %(message)s",
    "unrecognized arguments: %s",
    "not allowed with argument %s",
    "ignored explicit argument %r",
    "the following arguments are required: %s",
    "one of the arguments %s is required",
    "expected one argument",
    "expected at most one argument",
    "expected at least one argument",
    "expected %s argument",
    "expected %s arguments",
    "ambiguous option: %(option)s could match %(matches)s",
    "invalid %(type)s value: %(value)r",
    "invalid choice: %(value)r (choose from %(choices)s)",
    "unknown parser %(parser_name)r (choices: %(choices)s)",
)


@pytest.fixture(autouse=True)
def english_after():
    yield
    translate_argparse(str)


def test_every_text_of_the_help_is_german_and_has_the_same_values():
    root = ET.parse(FILE).getroot()  # noqa: S314 (a file of this repository)
    german = {one.findtext("source"): one.findtext("translation") for one in root.iter("message")}
    shown = set()
    translate_argparse(str)
    translate_parser(build_parser(), lambda text: shown.add(text) or text)
    wanted = shown | set(ERRORS)
    wanted = {text for text in wanted if not IDS.fullmatch(text) or text in german}
    assert wanted == german.keys()
    other = [en for en, de in german.items() if VALUE.findall(en) != VALUE.findall(de)]
    assert other == []


def test_help_and_errors_are_german_where_german_is_asked_for(capsys, monkeypatch):
    monkeypatch.setattr(language, "Settings", lambda: {})
    with pytest.raises(SystemExit):
        main(["--language", "de", "compare", "--help"])
    said = capsys.readouterr().out
    assert said.startswith("Aufruf: rotemina compare")
    assert "ein Bild zeichnen" in said
    assert "Optionen:" in said
    with pytest.raises(SystemExit):
        main(["--language=de", "compare"])
    assert "Fehler: diese Argumente fehlen: RECORD" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["--language", "en", "compare"])
    assert "error: the following arguments are required: RECORD" in capsys.readouterr().err
