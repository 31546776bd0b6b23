"""Preferences: kept between starts, never in the way of one."""

import pytest

from rotemina.app.settings import Settings


def test_what_is_set_is_there_at_the_next_start(tmp_path):
    path = tmp_path / "deep" / "settings.json"
    Settings(path).set("window.theme", "light")
    assert Settings(path).get("window.theme", "dark") == "light"


@pytest.mark.parametrize("text", ["", "{", "[1, 2]", "\x00", '{"window.theme": 3}', "[" * 100_000])
def test_a_spoilt_file_falls_back_to_defaults(tmp_path, text):
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
