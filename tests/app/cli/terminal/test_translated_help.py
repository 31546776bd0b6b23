"""The German help of the command line is complete and current, with the same placeholders."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from rotemina.app.cli.main import build_parser, main
from rotemina.app.cli.terminal import language, translate_argparse, translate_parser

TRANSLATION_FILE = Path(__file__).parents[4] / "resources" / "languages" / "de" / "help.ts"
PLACEHOLDER = re.compile(r"%\(\w+\)\w|%[srdg%]")
IDS = re.compile(r"[a-z-]+(, [a-z-]+)*")  # names that the user types
# Messages of argparse itself, in addition to the texts of the parsers.
ARGPARSE_MESSAGES = (
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
def restore_english():
    yield
    translate_argparse(str)


def test_every_help_text_is_translated_with_the_same_placeholders():
    root = ET.parse(TRANSLATION_FILE).getroot()  # noqa: S314 (a file of this repository)
    german = {
        message.findtext("source"): message.findtext("translation")
        for message in root.iter("message")
    }
    help_texts = set()
    translate_argparse(str)
    translate_parser(build_parser(), lambda text: help_texts.add(text) or text)
    expected = help_texts | set(ARGPARSE_MESSAGES)
    expected = {text for text in expected if not IDS.fullmatch(text) or text in german}
    assert expected == german.keys()
    mismatches = [
        en for en, de in german.items() if PLACEHOLDER.findall(en) != PLACEHOLDER.findall(de)
    ]
    assert mismatches == []


def test_help_and_errors_follow_the_language_option(capsys, monkeypatch):
    monkeypatch.setattr(language, "UserSettings", lambda: {})
    with pytest.raises(SystemExit):
        main(["--language", "de", "compare", "--help"])
    output = capsys.readouterr().out
    assert output.startswith("Aufruf: rotemina compare")
    assert "ein Bild zeichnen" in output
    assert "Optionen:" in output
    with pytest.raises(SystemExit):
        main(["--language=de", "compare"])
    assert "Fehler: diese Argumente fehlen: RECORD" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["--language", "en", "compare"])
    assert "error: the following arguments are required: RECORD" in capsys.readouterr().err
