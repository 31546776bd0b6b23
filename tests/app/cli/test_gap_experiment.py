"""``rotemina gap diagnose`` on records that are too poor, and what then tells more."""

import json
from html import escape
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
TRUTH = AxisEffect(axis="zn", id="delay", parameters={"delay": 3e-3})


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def write_measured(commands, name):
    record = simulate(ROBOT, [TRUTH], commands, np.random.default_rng(0))
    signals = {
        (axis, tap): record.signal(axis, tap)
        for axis, tap in record.columns
        if tap in (Tap.CMD, Tap.MEAS)
    }
    write_record(Record.from_signals(record.time_s, signals, record.units), name)


@pytest.mark.slow
def test_a_sine_alone_is_too_poor_and_the_suggested_test_then_tells(capsys):
    time_s = np.arange(4000) / 1000.0
    sine = 32.5e-6 + 13e-6 * np.minimum(time_s, 1.0) * np.sin(2.0 * np.pi * time_s)
    write_measured(Record.from_signals(time_s, {("zn", Tap.CMD): sine}, {"zn": "m"}), "sine.csv")
    asked = ["gap", "diagnose", "sine.csv", "--json", "out.json", "--report", "out.html"]
    assert main(asked) == 0
    first = json.loads(Path("out.json").read_text("utf-8"))
    assert first["verdict"] == "insufficient_excitation"
    [experiment] = first["next_experiments"]
    assert "delay" in experiment["splits"]
    assert escape(experiment["why"]) in Path("out.html").read_text("utf-8")

    capsys.readouterr()
    assert main(["play", experiment["commands"], "-o", "played.csv"]) == 0
    assert capsys.readouterr().err == "Model: RoTeMiNa (built in); choose another with --robot\n"
    assert read_record("played.csv", robot=ROBOT).has("zn", Tap.MEAS)

    write_measured(read_record(experiment["commands"], robot=ROBOT), "suggested.csv")
    assert main(["gap", "diagnose", "sine.csv", "suggested.csv", "--json", "then.json"]) == 0
    then = json.loads(Path("then.json").read_text("utf-8"))
    assert then["verdict"] == "explained"
    assert [(one["effect"], one["ambiguous_with"]) for one in then["causes"]] == [("delay", [])]
    assert then["next_experiments"] == []
