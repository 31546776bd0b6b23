"""The language of the command line: as asked for, as set for the window, else the system's."""

import pytest

from rotemina.app.cli import language
from rotemina.app.cli.main import main
from rotemina.sim.messages import Wording


@pytest.fixture(autouse=True)
def unset(monkeypatch, tmp_path):
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(language, "Settings", lambda: {})
    monkeypatch.chdir(tmp_path)


def refusal(capsys, *arguments):
    assert main([*arguments, "gap", "diagnose", "missing.csv"]) == 2
    return capsys.readouterr().err


def test_a_refusal_is_german_where_german_is_asked_for_or_spoken(capsys, monkeypatch):
    english = "rotemina: missing.csv cannot be read (file not found); name a record file\n"
    german = (
        "rotemina: missing.csv kann nicht gelesen werden (Datei nicht gefunden); eine Datei "
        "mit einer Aufzeichnung angeben\n"
    )
    assert refusal(capsys) == english
    assert refusal(capsys, "--language", "de") == german
    monkeypatch.setenv("LANG", "de_AT.UTF-8")
    assert refusal(capsys) == german
    assert refusal(capsys, "--language", "en") == english


def test_the_windows_choice_comes_before_the_systems(monkeypatch):
    monkeypatch.setenv("LANG", "de_DE.UTF-8")
    monkeypatch.setenv("LC_ALL", "C")
    assert language.chosen() == "C"
    assert type(language.wording()) is Wording
    monkeypatch.setenv("LANGUAGE", "de:en")
    assert language.chosen() == "de"
    monkeypatch.setattr(language, "Settings", lambda: {language.LANGUAGE: "en"})
    assert language.chosen() == "en"
