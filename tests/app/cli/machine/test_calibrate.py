"""``rotemina calibrate`` from the command line."""

import json

import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records import Record, Tap, read_record, write_record

ROBOT = """
[robot]
name = "bench"
axes = ["q"]

[axis.q]
kind = "piezo"
range = [0.0, 65.0e-6]
voltage_range = [0.0, 130.0]
gain = 5.0e-7
max_speed = 5.0e-3
max_acceleration = 5.0
mass = 0.15
damping = 19.792
stiffness = 1.04460e6
sensor.kind = "strain_gauge"
sensor.resolution = 7.9e-9
sensor.noise_rms = 1.2e-8

[[axis.q.effect]]
id = "sensor_gain"
error = 0.03

[reference]
noise_rms.linear = 5.0e-9
"""
RUN_OPTIONS = ["--axis", "q", "--robot", "bench.toml", "--runs", "3", "--rate", "500"]
FIT_OPTIONS = ["--axis", "q", "--robot", "bench.toml"]


@pytest.fixture(autouse=True)
def robot_file(in_tmp):
    path = in_tmp / "bench.toml"
    path.write_text(ROBOT)
    return path


def test_from_a_plan_to_a_stored_calibration(capsys):
    assert main(["calibrate", "plan", *RUN_OPTIONS, "-o", "motion.csv"]) == 0
    assert "3 runs, triangles and moves" in capsys.readouterr().out
    assert main(["play", "motion.csv", "--robot", "bench.toml", "--dry-run"]) == 0
    capsys.readouterr()

    outputs = ["--record", "it.csv", "--out", "q.toml", "--json", "--store", "--folder", "user"]
    assert main(["calibrate", "run", *RUN_OPTIONS, *outputs]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert summary["figures"]["gain error"]["value"] == pytest.approx(0.03, abs=1e-4)
    assert summary["refused"] is None
    assert len(summary["written"]) == 2

    assert main(["calibrate", "fit", "it.csv", *FIT_OPTIONS, "--json"]) == 0
    refitted = json.loads(capsys.readouterr().out)
    assert refitted["figures"] == summary["figures"]

    assert main(["calibrate", "show", "q.toml"]) == 0
    output = capsys.readouterr().out
    assert "gain error" in output
    assert "from it.csv" in output
    assert main(["calibrate", "show", "q.toml", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["axis"] == "q"
    assert main(["calibrate", "list", "--robot", "bench.toml", "--folder", "user"]) == 0
    assert "  on  " in capsys.readouterr().out


def test_bad_request_is_refused_and_replaces_nothing(robot_file, capsys, get_refusal):
    robot_file.write_text(ROBOT.replace("error = 0.03", "error = 0.0"))
    run_arguments = ["calibrate", "run", *RUN_OPTIONS, "--record", "it.csv"]
    assert main(run_arguments) == 0  # it is reported, and no output was requested
    assert "refused" in capsys.readouterr().out
    robot_file.with_name("q.toml").write_text("before")
    fit_arguments = ["calibrate", "fit", "it.csv", *FIT_OPTIONS, "--out", "q.toml"]
    assert main(fit_arguments) == 2
    assert "not better" in capsys.readouterr().err
    assert robot_file.with_name("q.toml").read_text() == "before"

    record = read_record("it.csv")
    signals = {("q", tap): record.signal("q", tap) for tap in (Tap.CMD, Tap.MEAS)}
    write_record(Record.from_signals(record.time_s, signals, record.units), "blind.csv")
    for arguments, message in (
        (["fit", "blind.csv", *FIT_OPTIONS], "no column q.ref"),
        (["fit", "it.csv", "--axis", "p", "--robot", "bench.toml"], "axis 'p'"),
        (
            ["fit", "it.csv", *FIT_OPTIONS, "--laser", "a.csv", "--laser", "b.csv"],
            "2 files for 1 records",
        ),
        (["fit", "none.csv", *FIT_OPTIONS], "none.csv"),
        (["show", "bench.toml"], "bench.toml"),
        (
            ["plan", "--axis", "q", "--robot", "bench.toml", "--runs", "1", "-o", "m.csv"],
            "runs = 1",
        ),
    ):
        assert message in get_refusal(["calibrate", *arguments])
