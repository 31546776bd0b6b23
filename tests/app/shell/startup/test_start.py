"""Starting with and without a display, and on a machine with missing libraries."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtGui import QImage

from rotemina.app.cli.main import main
from rotemina.app.shell.startup import window_start as module
from rotemina.app.shell.startup.display_check import find_display_fault
from rotemina.app.system.system_check import DebianPackage
from rotemina.sim.records import read_record

OUTPUT_FILES = {"window.png", "comparison.svg", "comparison.json", "report.txt", "record.csv"}
linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux has a choice")


@linux
@pytest.mark.slow
def test_without_a_display_the_run_is_done_and_its_folder_named(tmp_path):
    display_variables = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
    environment = {key: value for key, value in os.environ.items() if key not in display_variables}
    command = [Path(sys.executable).with_name("rotemina"), "--output", "left"]
    result = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""
    assert "no DISPLAY or WAYLAND_DISPLAY" in result.stdout
    assert str(tmp_path / "left") in result.stdout
    assert {path.name for path in (tmp_path / "left").iterdir()} >= OUTPUT_FILES
    picture = QImage(str(tmp_path / "left" / "window.png"))
    assert (picture.width(), picture.height()) == (1280, 800)
    colours = {picture.pixel(x, y) for x in range(0, 1280, 7) for y in range(0, 800, 7)}
    assert len(colours) > 20
    assert len(read_record(tmp_path / "left" / "record.csv").time_s) > 1000


@linux
def test_a_display_that_does_not_answer_is_reported(monkeypatch):
    monkeypatch.delenv("QT_QPA_PLATFORM", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setenv("DISPLAY", ":4711")
    assert find_display_fault() == "the display ':4711' does not answer"


def test_a_missing_library_is_one_line_with_the_command(monkeypatch, capsys, tmp_path):
    missing = [DebianPackage("libxcb-cursor0", "libxcb-cursor.so.0")]
    monkeypatch.setattr(module, "find_missing_libraries", lambda platform: missing)
    assert main(["--offscreen", "--output", str(tmp_path / "left")]) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "apt-get install -y --no-install-recommends libxcb-cursor0" in error
    assert not (tmp_path / "left").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["--driver", "nobody"],
            "there is no driver 'nobody'; installed: gcode, mc68hc11, simulator",
        ),
        (["--robot", "nobody"], "nobody: no such robot file"),
        (["--set", "colour=red"], "driver 'simulator' has no setting 'colour'; available"),
        (["--set", "start_fraction=7"], "start_fraction"),
    ],
)
def test_a_bad_option_is_one_clear_line(arguments, message, capsys):
    assert main([*arguments, "--offscreen"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert message in error


def test_a_folder_that_cannot_be_made_is_one_clear_line(qapp, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("rotemina.app.shell.startup.qt_setup.log_qt_messages", lambda: None)
    (tmp_path / "taken").write_text("a file", "utf-8")
    assert main(["--offscreen", "--output", str(tmp_path / "taken")]) == 2
    assert "taken: the folder cannot be created" in capsys.readouterr().err
