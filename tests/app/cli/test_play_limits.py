"""``rotemina play`` on a machine whose robot file limits no speed."""

from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record


@pytest.fixture(autouse=True)
def trajectory(tmp_path, monkeypatch):
    """A swing of a piezo that reaches 63 µm/s."""
    monkeypatch.chdir(tmp_path)
    time_s = np.arange(1001) / 1000.0
    command = 20e-6 - 10e-6 * np.cos(2.0 * np.pi * time_s)
    write_record(Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"}), "t.csv")


def test_it_is_not_played_without_a_greatest_speed(capsys):
    assert main(["play", "t.csv", "--robot", "picma", "-o", "r.csv"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "states no speed limit (max_speed) of p" in error
    assert "--max-speed p=1mm/s" in error
    assert not Path("r.csv").exists()


def test_it_is_played_within_the_speed_that_was_given(capsys):
    asked = ["play", "t.csv", "--robot", "picma", "-o", "r.csv", "--max-speed"]
    assert main([*asked, "p=70um/s"]) == 0
    assert Path("r.csv").exists()
    assert main([*asked, "60um/s"]) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert "axis p: speed 62.8" in error
    assert "µm/s at row 251, t = 0.25 s is beyond the limit 60 µm/s" in error


def test_a_dry_run_says_what_was_checked_and_what_has_no_limit(capsys):
    asked = ["play", "t.csv", "--robot", "picma", "--dry-run"]
    assert main(asked) == 0
    said = capsys.readouterr().out
    assert "within the limits" not in said
    assert (
        "inside the range and the voltage; no limit is stated for the speed of p and the "
        "acceleration of p" in said
    )
    assert main([*asked, "--max-speed", "1mm/s"]) == 0
    assert (
        "inside the range, the voltage and the speed of p; no limit is stated for the "
        "acceleration of p" in capsys.readouterr().out
    )


def test_an_axis_that_stays_where_it_is_needs_no_limit(capsys):
    Path("still.csv").write_text("t [s],p [um]\n0,20\n0.1,20\n", "utf-8")
    assert main(["play", "still.csv", "--robot", "picma", "-o", "r.csv"]) == 0
