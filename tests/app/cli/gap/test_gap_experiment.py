"""``rotemina gap diagnose`` on a record with too little excitation, then with its experiment."""

import json
from html import escape
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records import Record, Tap, read_record, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
TRUE_EFFECT = AxisEffect(axis="zn", id="delay", parameters={"delay": 3e-3})


def write_measured(commands, name):
    record = simulate(ROBOT, [TRUE_EFFECT], commands, np.random.default_rng(0))
    signals = {
        (axis, tap): record.signal(axis, tap)
        for axis, tap in record.columns
        if tap in (Tap.CMD, Tap.MEAS)
    }
    write_record(Record.from_signals(record.time_s, signals, record.units), name)


@pytest.mark.slow
def test_suggested_experiment_resolves_a_poorly_exciting_sine(capsys):
    time_s = np.arange(4000) / 1000.0
    sine = 32.5e-6 + 13e-6 * np.minimum(time_s, 1.0) * np.sin(2.0 * np.pi * time_s)
    write_measured(Record.from_signals(time_s, {("zn", Tap.CMD): sine}, {"zn": "m"}), "sine.csv")
    arguments = ["gap", "diagnose", "sine.csv", "--json", "out.json", "--report", "out.html"]
    assert main(arguments) == 0
    first_diagnosis = json.loads(Path("out.json").read_text("utf-8"))
    assert first_diagnosis["verdict"] == "insufficient_excitation"
    [experiment] = first_diagnosis["next_experiments"]
    assert "delay" in experiment["splits"]
    assert escape(experiment["why"]) in Path("out.html").read_text("utf-8")

    capsys.readouterr()
    assert main(["play", experiment["commands"], "-o", "played.csv"]) == 0
    assert capsys.readouterr().err == "Model: RoTeMiNa (built in); choose another with --robot\n"
    assert read_record("played.csv", robot=ROBOT).has("zn", Tap.MEAS)

    write_measured(read_record(experiment["commands"], robot=ROBOT), "suggested.csv")
    assert main(["gap", "diagnose", "sine.csv", "suggested.csv", "--json", "then.json"]) == 0
    second_diagnosis = json.loads(Path("then.json").read_text("utf-8"))
    assert second_diagnosis["verdict"] == "explained"
    assert [(cause["effect"], cause["ambiguous_with"]) for cause in second_diagnosis["causes"]] == [
        ("delay", [])
    ]
    assert second_diagnosis["next_experiments"] == []
