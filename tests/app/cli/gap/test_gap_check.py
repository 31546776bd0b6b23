"""``rotemina gap check``."""

import json

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate


@pytest.fixture(scope="module")
def record_file(tmp_path_factory):
    """Return a record of zn, which moves by small slow sines."""
    robot = load_robot("rotemina")
    time_s = np.arange(1500) / 500.0
    command = 32e-6 + 5e-6 * np.sin(3.0 * time_s)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    path = tmp_path_factory.mktemp("check") / "slow.csv"
    write_record(simulate(robot, (), commands, np.random.default_rng(0)), path)
    return path


def test_the_check_names_shown_and_hidden_effects_and_a_motion_for_these(
    record_file, tmp_path, capsys
):
    output = tmp_path / "check.json"
    assert main(["gap", "check", str(record_file), "--json", str(output)]) == 0
    text = capsys.readouterr().out
    assert "zn: these records can show, at the typical size" in text
    assert "play this:" in text
    document = json.loads(output.read_text("utf-8"))
    assert document["format"] == "rotemina-check 1"
    axis = document["axes"]["zn"]
    assert all(item["floors"] >= 3.0 for item in axis["shown"])
    assert all(item["floors"] < 3.0 for item in axis["hidden"])
    assert "delay" in {item["effect"] for item in axis["hidden"] if item["test"]}
    assert "sensor_noise" in axis["in_any_motion"]


def test_the_check_does_not_overwrite_a_record(record_file, capsys):
    before = record_file.read_bytes()
    assert main(["gap", "check", str(record_file), "--json", str(record_file)]) == 2
    assert str(record_file) in capsys.readouterr().err
    assert record_file.read_bytes() == before


def test_an_output_that_cannot_be_written_is_refused_at_once(
    record_file, tmp_path, capsys, monkeypatch
):
    arguments = ["gap", "check", str(record_file), "--json"]
    assert main([*arguments, str(tmp_path)]) == 2
    assert f"{tmp_path} is a folder; name a file" in capsys.readouterr().err
    assert main([*arguments, str(tmp_path / "none" / "out.json")]) == 2
    assert "there is no folder" in capsys.readouterr().err
    # A test that runs as root could write to any folder.
    monkeypatch.setattr("os.access", lambda *_: False)
    assert main([*arguments, str(tmp_path / "out.json")]) == 2
    assert f"no permission to create files in {tmp_path}" in capsys.readouterr().err
