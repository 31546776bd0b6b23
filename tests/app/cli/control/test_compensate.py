"""``rotemina compensate``: files, output and refusals."""

import json
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.compensate import anfis, read_trained
from rotemina.sim.records import Record, Tap, read_record, write_record

ROWS = 3000


@pytest.fixture(autouse=True)
def quick_training(monkeypatch):
    monkeypatch.setattr(anfis.AnfisSettings, "__init__", _set_quick_settings)


def _set_quick_settings(self):
    """Initialise ANFIS settings that train in an instant."""
    values = {"memberships": 3, "plays": (), "epochs": 2, "patience": 2}
    for name, value in values.items():
        object.__setattr__(self, name, value)


def write_looped_record(name, axes=("zn",), taps=(Tap.CMD, Tap.MEAS), phase=0.0):
    """Write a record of a curved response with a small backlash-like loop."""
    spans = {"thx": 1.16355e-3, "zn": 65e-6, "x": 0.055}
    phases = np.linspace(0.0, 60.0, ROWS) + phase
    shares = 0.5 - 0.48 * np.linspace(1.0, 0.2, ROWS) * np.cos(phases)
    positions, play = np.empty(ROWS), 0.0
    for k, x in enumerate(shares):
        play = max(x - 0.1, min(x + 0.1, play))
        positions[k] = 0.8 * x + 0.15 * play + 0.05 * x * x
    signals = {
        (axis, tap): spans[axis] * (positions if tap is Tap.MEAS else shares)
        for axis in axes
        for tap in taps
    }
    units = {axis: "rad" if axis == "thx" else "m" for axis in axes}
    write_record(Record.from_signals(np.arange(ROWS) * 1e-3, signals, units), name)


def test_train_then_check(capsys, get_refusal):
    write_looped_record("a.csv")
    write_looped_record("b.csv", phase=0.4)
    assert main(["compensate", "train", "a.csv", "-o", "zn.json"]) == 0
    output = capsys.readouterr()
    assert "recommended: " in output.out
    assert "zn.json: 4 inverses" in output.out
    trained, provenance = read_trained("zn.json")
    assert [source.name for source in provenance.trained_on] == ["a.csv"]
    assert len(provenance.trained_on[0].sha256) == 64
    assert provenance.versions["numpy"] == np.__version__
    assert main(["compensate", "check", "zn.json", "b.csv"]) == 0
    lines = capsys.readouterr().out.splitlines()
    kinds = ("ANFIS", "modified Prandtl–Ishlinskii", "Prandtl–Ishlinskii", "linear")
    for kind in kinds:
        assert any(line.startswith(kind + " ") for line in lines)
    assert main(["compensate", "check", "zn.json", "b.csv", "--json", "-"]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["recommended"] == trained.recommended_kind
    residuals = figures["residuals"]
    assert residuals["modified_prandtl_ishlinskii"]["rms"] < 0.2 * residuals["linear"]["rms"]
    refusal = get_refusal("compensate check zn.json a.csv --robot picma")
    assert "was trained for robot 'RoTeMiNa', not for" in refusal


def test_held_out_record_is_used_for_the_evaluation():
    write_looped_record("a.csv")
    write_looped_record("b.csv", phase=0.4)
    arguments = "compensate train a.csv --held-out b.csv -o zn.json --json figures.json"
    assert main(arguments.split()) == 0
    _, provenance = read_trained("zn.json")
    assert [source.name for source in provenance.held_out] == ["b.csv"]
    assert json.loads(Path("figures.json").read_text("utf-8"))["axis"] == "zn"


@pytest.mark.slow
def test_training_on_the_simulator_is_reproducible_by_seed():
    for name, seed in (("a.json", "3"), ("b.json", "3"), ("c.json", "4")):
        arguments = f"compensate train --simulate --axis zn --seed {seed} -o {name}"
        assert main(arguments.split()) == 0
    assert Path("a.json").read_bytes() == Path("b.json").read_bytes()
    assert Path("a.json").read_bytes() != Path("c.json").read_bytes()
    assert read_trained("a.json")[1].seed == 3


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("train -o it.json", "no record is named"),
        ("train a.csv --simulate --axis zn -o it.json", "--simulate takes no records"),
        ("train --simulate -o it.json", "--simulate needs --axis NAME"),
        ("train a.csv --seed 1 -o it.json", "--effects and --seed belong to --simulate"),
        ("train a.csv -o no/it.json", "there is no folder no"),
        ("train two.csv --held-out a.csv -o link.csv", "link.csv is named twice"),
        ("train a.csv -o it.json --json it.json", "it.json is named twice"),
        ("check it.json a.csv --json link.csv", "link.csv is named twice"),
        ("apply it.json a.csv -o link.csv", "link.csv is named twice"),
        ("train two.csv -o it.json", "two.csv: its piezo axes are thx, zn; name one by --axis"),
        ("train a.csv --axis thx -o it.json", "axis thx needs the columns thx.cmd"),
        ("train x.csv --axis x -o it.json", "has no such piezo axis; use one of thx, thy, zn"),
        ("train bare.csv -o it.json", "needs the columns zn.cmd and zn.meas or zn.ref"),
        ("check a.csv a.csv", "a.csv: the file: Invalid JSON"),
        ("check none.json a.csv", "none.json cannot be read"),
    ],
)
def test_bad_request_is_refused(arguments, message, get_refusal):
    write_looped_record("a.csv")
    write_looped_record("two.csv", axes=("thx", "zn"))
    write_looped_record("x.csv", axes=("x",))
    write_looped_record("bare.csv", taps=(Tap.CMD,))
    Path("link.csv").symlink_to("a.csv")
    assert message in get_refusal(f"compensate {arguments}")


def test_trajectory_is_compensated_and_played(capsys):
    write_looped_record("a.csv")
    assert main(["compensate", "train", "a.csv", "-o", "zn.json"]) == 0
    time_s = 1e-3 * np.arange(300)
    position = 30e-6 - 10e-6 * np.cos(20.0 * time_s)
    trajectory = Record.from_signals(time_s, {("zn", Tap.CMD): position}, {"zn": "m"})
    write_record(trajectory, "way.csv")
    assert main(["compensate", "apply", "zn.json", "way.csv", "-o", "sent.csv"]) == 0
    assert "sent.csv: 300 rows, 0.299 s\naxis zn: commands of" in capsys.readouterr().out
    compensated = read_record("sent.csv")
    assert compensated.metadata["compensation zn"].endswith(", zn.json")
    assert np.abs(compensated.signal("zn", Tap.CMD) - position).max() > 1e-7
    assert main(["play", "sent.csv", "-o", "played.csv"]) == 0
    assert main(["play", "way.csv", "--compensate", "zn.json", "-o", "live.csv"]) == 0
    live_record = read_record("live.csv")
    assert np.allclose(live_record.signal("zn", Tap.CMD), position, atol=1e-12)
    assert live_record.metadata["compensation zn"] == compensated.metadata["compensation zn"]
    # Computed ahead or extrapolated live, the inverse commands are nearly the same.
    played_commands = read_record("played.csv").signal("zn", Tap.CMD)
    assert np.abs(live_record.signal("zn", Tap.U) * 5e-7 - played_commands)[50:].max() < 1e-6

    write_record(
        Record.from_signals(time_s, {("zn", Tap.CMD): position + 24.9e-6}, {"zn": "m"}), "f.csv"
    )
    for arguments in ("compensate apply zn.json f.csv -o o.csv", "play f.csv --compensate zn.json"):
        assert main(arguments.split()) == 2
        assert "inverse of axis zn" in capsys.readouterr().err
    assert main(["compensate", "apply", "zn.json", "way.csv", "-o", "way.csv"]) == 2
    assert "way.csv is named twice" in capsys.readouterr().err
