"""``rotemina plate``: output, files and refusals."""

from dataclasses import replace

import numpy as np

from rotemina.app.cli.main import main
from rotemina.sim.robot_files import load_robot, write_robot

COARSE = ["--divisions", "32"]


def test_solve_reports_and_writes(tmp_path, capsys):
    vtu, table = tmp_path / "plate.vtu", tmp_path / "ramp.csv"
    options = ["--vtu", str(vtu), "--ramp", str(table), "--modes", "3", "--back"]
    assert main(["plate", "solve", *COARSE, *options, "--thx", "500"]) == 0
    output = capsys.readouterr().out
    for text in ("von Mises", "safety", "reaction", "whole range of motion", "Hz", "friction"):
        assert text in output
    assert vtu.exists()
    rows = np.genfromtxt(table, delimiter=",", names=True)
    assert rows["time_s"][-1] == 30.0
    assert rows["bottom_thx_rad"].max() == 500e-6
    assert rows["moment_x_Nm"][-1] == 0.0


def test_apply_writes_a_robot(tmp_path, capsys):
    path = tmp_path / "robot.toml"
    assert main(["plate", "apply", *COARSE, "-o", str(path)]) == 0
    output = capsys.readouterr().out
    assert "axis.thx.stiffness" in output
    assert "within 5 %" in output
    assert load_robot(path).axes["zn"].stiffness != load_robot("rotemina").axes["zn"].stiffness
    assert main(["plate", "apply", *COARSE, "-o", str(path)]) == 2
    assert "already exists" in capsys.readouterr().err


def test_bad_requests_are_refused(get_refusal):
    for options, reason in [
        (["--divisions", "3"], "must be 16 to 2000"),
        ([*COARSE, "--modes", "0"], "modes = 0"),
        ([*COARSE, "--zn", "nan"], "finite"),
        ([*COARSE, "--zn", "1e9"], "cannot move that far"),
        ([*COARSE, "--seconds", "-1"], "duration of the ramp"),
    ]:
        assert reason in get_refusal(["plate", "solve", *options])


def test_yield_is_reported(tmp_path, capsys):
    robot = load_robot("rotemina")
    weak_robot = replace(robot, plate=replace(robot.plate, yield_stress=1.5e8))
    path = tmp_path / "weak.toml"
    write_robot(weak_robot, path)
    assert main(["plate", "solve", *COARSE, "--robot", str(path), "--modes", "1"]) == 0
    output = capsys.readouterr().out
    assert output.count("THE PLATE YIELDS") == 2
    assert "at the hub, r 5.17 mm" in output
    assert main(["plate", "apply", *COARSE, "--robot", str(path), "-o", str(tmp_path / "o")]) == 2
    assert "the plate yields within the range of motion" in capsys.readouterr().err


def test_large_deflections_are_reported(tmp_path, capsys):
    robot = load_robot("rotemina")
    clamped_plate = replace(robot.plate, joint=replace(robot.plate.joint, clamp_force=1e5))
    path = tmp_path / "tight.toml"
    write_robot(replace(robot, plate=clamped_plate), path)
    options = ["--robot", str(path), "--modes", "1", "--zn", "400"]
    assert main(["plate", "solve", *COARSE, *options]) == 0
    output = capsys.readouterr().out
    assert "BEYOND LINEAR THEORY: it bends by 3" in output
    assert "THE PLATE YIELDS" in output
