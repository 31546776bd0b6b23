"""Preferences: kept between starts, never in the way of one."""

import os
from unittest.mock import Mock

import pytest

from rotemina.app.settings import Settings


def test_what_is_set_is_there_at_the_next_start(tmp_path):
    path = tmp_path / "deep" / "settings.json"
    Settings(path).set("window.theme", "light")
    assert Settings(path).get("window.theme", "dark") == "light"


@pytest.mark.parametrize("text", ["", "{", "[1, 2]", "\x00", "[" * 100_000])
def test_a_spoilt_file_is_kept_beside_the_new_one(tmp_path, text):
    path = tmp_path / "settings.json"
    for number in (1, 2):
        path.write_text(text, "utf-8")
        settings = Settings(path)
        assert str(path) in settings.fault
        settings.set("window.theme", "light")
        assert settings.aside == tmp_path / f"settings.damaged-{number}.json"
        assert settings.aside.read_text("utf-8") == text
        assert Settings(path).get("window.theme", "dark") == "light"
        assert Settings(path).fault == ""


def test_what_cannot_be_moved_is_never_overwritten(tmp_path, monkeypatch):
    path = tmp_path / "settings.json"
    path.write_text("{", "utf-8")
    monkeypatch.setattr("pathlib.Path.rename", Mock(side_effect=OSError("read-only")))
    settings = Settings(path)
    settings.set("window.theme", "light")
    assert settings.get("window.theme", "dark") == "light"
    assert (settings.aside, path.read_text("utf-8")) == (None, "{")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are of POSIX")
def test_a_pipe_in_its_place_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "settings.json")
    assert "a pipe" in Settings(tmp_path / "settings.json").fault


@pytest.mark.parametrize("text", ['{"window.theme": 3}', '{"window.theme": null}'])
def test_a_value_of_another_kind_falls_back_to_the_default(tmp_path, text):
    path = tmp_path / "settings.json"
    path.write_text(text, "utf-8")
    settings = Settings(path)
    assert settings.get("window.theme", "dark") == "dark"
    settings.set("window.theme", "light")
    assert Settings(path).get("window.theme", "dark") == "light"


def test_a_switch_is_no_number(tmp_path):
    settings = Settings(tmp_path / "settings.json")
    settings.set("plots.seconds", True)
    assert settings.get("plots.seconds", 10) == 10


def test_a_place_that_cannot_be_written_is_no_failure(tmp_path, caplog):
    (tmp_path / "file").write_text("", "utf-8")
    settings = Settings(tmp_path / "file" / "settings.json")
    settings.set("window.theme", "light")
    assert settings.get("window.theme", "dark") == "light"
    assert "cannot be kept" in caplog.text
