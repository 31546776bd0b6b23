"""The model that a command uses: named on stderr, and never compared with a stranger's record."""

import json
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record

BUILT_IN = "Model: RoTeMiNa (built in); choose another with --robot"
TIME_S = np.arange(400) / 1000.0


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def write(name, highest, measured=None):
    """Write a record of x between 20 mm and some other place."""
    command = np.linspace(0.02, highest, len(TIME_S))
    signals = {("x", Tap.CMD): command, ("x", Tap.MEAS): command if measured is None else measured}
    write_record(Record.from_signals(TIME_S, signals, {"x": "m"}), name)


@pytest.mark.parametrize(
    "command",
    [
        "compare r.csv --json -",
        "simulate r.csv -o s.csv",
        "play t.csv -o p.csv",
        "excite sine --axes x -o e.csv",
        "calibrate plan --axis x -o c.csv",
        "recording report r.csv -o r.html",
        "effect show delay",
    ],
)
def test_the_first_line_on_stderr_names_the_model(command, capsys):
    write("r.csv", 0.0201)
    Path("t.csv").write_text("t [s],x [mm]\n0,20\n1,20\n", "utf-8")
    assert main(command.split()) == 0
    said = capsys.readouterr()
    assert said.err.splitlines()[0] == BUILT_IN
    assert "Model:" not in said.out
    if "--json -" in command:
        assert json.loads(said.out)["format"] == "rotemina-comparison 1"


def test_a_model_from_a_file_is_named_with_its_file(capsys):
    Path("own.toml").write_text(
        '[robot]\nname = "Mine"\naxes = ["x"]\n[axis.x]\nkind = "piezo"\nunit = "m"\n'
        "range = [0.0, 0.2]\ngain = 1.0\nstatic = true\n",
        "utf-8",
    )
    write("r.csv", 0.1)
    assert main(["compare", "r.csv", "--robot", "own.toml"]) == 0
    assert capsys.readouterr().err == "Model: Mine (own.toml)\n"


@pytest.mark.parametrize(
    "command",
    [
        "gap diagnose far.csv",
        "compare far.csv",
        "simulate far.csv -o s.csv",
        "play far.csv -o p.csv",
        "play far.csv --dry-run",
        "calibrate fit far.csv --axis x",
        "recording report far.csv -o r.html",
    ],
)
def test_a_record_whose_commands_leave_the_range_far_is_refused(command, capsys):
    write("far.csv", 0.08)
    assert main(command.split()) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert "far.csv: x.cmd = 80 mm at row 400 is outside the range 0 mm to 55 mm" in error
    assert "bound 57.75 mm" in error
    assert "choose its model with --robot" in error
    assert [path.name for path in Path().iterdir()] == ["far.csv"]


def test_a_little_beyond_the_range_and_measured_values_are_no_reason_to_refuse(capsys):
    write("r.csv", 0.0577, measured=np.full(len(TIME_S), 3.0))
    assert main(["compare", "r.csv"]) == 0


def test_two_runs_of_a_stranger_may_be_compared_with_each_other(capsys):
    for name in ("a.csv", "b.csv"):
        write(name, 0.08)
    assert main(["compare", "a.csv", "--with", "b.csv"]) == 0
