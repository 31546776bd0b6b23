"""The language of the command line: the option, else the window's setting, else the system's."""

import pytest

from rotemina.app.cli.main import main
from rotemina.app.cli.terminal import language
from rotemina.sim.messages import MessageWording


@pytest.fixture(autouse=True)
def clear_language_settings(monkeypatch):
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(language, "UserSettings", lambda: {})


def run_refused_command(capsys, *arguments):
    assert main([*arguments, "gap", "diagnose", "missing.csv"]) == 2
    return capsys.readouterr().err


def test_refusal_is_german_by_option_or_environment(capsys, monkeypatch):
    english = "rotemina: missing.csv cannot be read (file not found); name a record file\n"
    german = (
        "rotemina: missing.csv kann nicht gelesen werden (Datei nicht gefunden); eine Datei "
        "mit einer Aufzeichnung angeben\n"
    )
    assert run_refused_command(capsys) == english
    assert run_refused_command(capsys, "--language", "de") == german
    monkeypatch.setenv("LANG", "de_AT.UTF-8")
    assert run_refused_command(capsys) == german
    assert run_refused_command(capsys, "--language", "en") == english


def test_window_setting_takes_precedence_over_the_system(monkeypatch):
    monkeypatch.setenv("LANG", "de_DE.UTF-8")
    monkeypatch.setenv("LC_ALL", "C")
    assert language.find_window_language() == "C"
    assert type(language.load_wording()) is MessageWording
    monkeypatch.setenv("LANGUAGE", "de:en")
    assert language.find_window_language() == "de"
    monkeypatch.setattr(language, "UserSettings", lambda: {language.LANGUAGE_KEY: "en"})
    assert language.find_window_language() == "en"
