"""Preferences are kept between starts and never prevent a start."""

import os
from unittest.mock import Mock

import pytest

from rotemina.app.settings import UserSettings


@pytest.mark.parametrize("text", ["", "[1, 2]", "\x00", "[" * 100_000])
def test_a_damaged_file_is_kept_next_to_the_new_one(tmp_path, text):
    path = tmp_path / "settings.json"
    for number in (1, 2):
        path.write_text(text, "utf-8")
        settings = UserSettings(path)
        assert str(path) in settings.load_error
        settings.set("window.theme", "light")
        assert settings.damaged_copy == tmp_path / f"settings.damaged-{number}.json"
        assert settings.damaged_copy.read_text("utf-8") == text
        assert UserSettings(path).get("window.theme", "dark") == "light"
        assert UserSettings(path).load_error == ""


def test_a_folder_that_is_missing_is_made(tmp_path):
    path = tmp_path / "deep" / "settings.json"
    UserSettings(path).set("window.theme", "light")
    assert UserSettings(path).get("window.theme", "dark") == "light"


def test_a_damaged_file_that_cannot_be_renamed_is_not_overwritten(tmp_path, monkeypatch):
    path = tmp_path / "settings.json"
    path.write_text("{", "utf-8")
    monkeypatch.setattr("pathlib.Path.rename", Mock(side_effect=OSError("read-only")))
    settings = UserSettings(path)
    settings.set("window.theme", "light")
    assert settings.get("window.theme", "dark") == "light"
    assert (settings.damaged_copy, path.read_text("utf-8")) == (None, "{")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes need POSIX")
def test_a_pipe_instead_of_the_file_does_not_block(tmp_path):
    os.mkfifo(tmp_path / "settings.json")
    assert "a pipe" in UserSettings(tmp_path / "settings.json").load_error


@pytest.mark.parametrize(("value", "default"), [("3", "dark"), ("null", "dark"), ("true", 10)])
def test_a_value_of_another_type_falls_back_to_the_default(tmp_path, value, default):
    path = tmp_path / "settings.json"
    path.write_text(f'{{"a.key": {value}}}', "utf-8")
    settings = UserSettings(path)
    assert settings.get("a.key", default) == default
    settings.set("a.key", "light")
    assert UserSettings(path).get("a.key", "dark") == "light"


def test_a_location_that_cannot_be_written_is_no_failure(tmp_path, caplog):
    (tmp_path / "file").write_text("", "utf-8")
    settings = UserSettings(tmp_path / "file" / "settings.json")
    settings.set("window.theme", "light")
    assert settings.get("window.theme", "dark") == "light"
    assert "cannot be stored" in caplog.text
