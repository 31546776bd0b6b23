"""A command names its model on stderr and refuses records of another machine."""

import json
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records import Record, Tap, write_record

BUILT_IN_MODEL_LINE = "Model: RoTeMiNa (built in); choose another with --robot"
TIME_S = np.arange(400) / 1000.0


def write_x_record(name, end_m, measured=None):
    """Write a record of x from 20 mm to ``end_m``."""
    command = np.linspace(0.02, end_m, len(TIME_S))
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
def test_first_line_on_stderr_names_the_model(command, capsys):
    write_x_record("r.csv", 0.0201)
    Path("t.csv").write_text("t [s],x [mm]\n0,20\n1,20\n", "utf-8")
    assert main(command.split()) == 0
    output = capsys.readouterr()
    assert output.err.splitlines()[0] == BUILT_IN_MODEL_LINE
    assert "Model:" not in output.out
    if "--json -" in command:
        assert json.loads(output.out)["format"] == "rotemina-comparison 1"


def test_model_from_a_file_is_named_with_its_file(capsys):
    Path("own.toml").write_text(
        '[robot]\nname = "Mine"\naxes = ["x"]\n[axis.x]\nkind = "piezo"\nunit = "m"\n'
        "range = [0.0, 0.2]\ngain = 1.0\nstatic = true\n",
        "utf-8",
    )
    write_x_record("r.csv", 0.1)
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
def test_record_with_commands_far_outside_the_range_is_refused(command, get_refusal):
    write_x_record("far.csv", 0.08)
    error = get_refusal(command)
    assert "far.csv: x.cmd = 80 mm at row 400 is outside the range 0 mm to 55 mm" in error
    assert "bound 57.75 mm" in error
    assert "choose its model with --robot" in error


def test_slight_excess_and_measured_values_are_accepted(capsys):
    write_x_record("r.csv", 0.0577, measured=np.full(len(TIME_S), 3.0))
    assert main(["compare", "r.csv"]) == 0


def test_two_runs_of_another_machine_can_be_compared_with_each_other(capsys):
    for name in ("a.csv", "b.csv"):
        write_x_record(name, 0.08)
    assert main(["compare", "a.csv", "--with", "b.csv"]) == 0
