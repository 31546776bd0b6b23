"""``rotemina play`` on a machine whose robot file limits no speed."""

from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records import Record, Tap, write_record


@pytest.fixture(autouse=True)
def trajectory(in_tmp):
    """Write a piezo motion that reaches 63 µm/s."""
    time_s = np.arange(1001) / 1000.0
    command = 20e-6 - 10e-6 * np.cos(2.0 * np.pi * time_s)
    write_record(Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"}), "t.csv")


def test_play_requires_a_speed_limit(get_refusal):
    error = get_refusal("play t.csv --robot picma -o r.csv")
    assert "states no speed limit (max_speed) of p" in error
    assert "--max-speed p=1mm/s" in error


def test_play_observes_the_given_speed_limit(capsys):
    arguments = ["play", "t.csv", "--robot", "picma", "-o", "r.csv", "--max-speed"]
    assert main([*arguments, "p=70um/s"]) == 0
    assert Path("r.csv").exists()
    assert main([*arguments, "60um/s"]) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert "axis p: speed 62.8" in error
    assert "µm/s at row 251, t = 0.25 s is beyond the limit 60 µm/s" in error


def test_dry_run_reports_checked_and_missing_limits(capsys):
    arguments = ["play", "t.csv", "--robot", "picma", "--dry-run"]
    assert main(arguments) == 0
    output = capsys.readouterr().out
    assert "within the limits" not in output
    assert (
        "inside the range and the voltage; no limit is stated for the speed of p and the "
        "acceleration of p" in output
    )
    assert main([*arguments, "--max-speed", "1mm/s"]) == 0
    assert (
        "inside the range, the voltage and the speed of p; no limit is stated for the "
        "acceleration of p" in capsys.readouterr().out
    )


def test_axis_at_rest_needs_no_limit(capsys):
    Path("still.csv").write_text("t [s],p [um]\n0,20\n0.1,20\n", "utf-8")
    assert main(["play", "still.csv", "--robot", "picma", "-o", "r.csv"]) == 0
