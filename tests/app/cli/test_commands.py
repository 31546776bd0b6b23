"""The command line: results, exit status, one clear line on bad input."""

import gzip
import json
import os
import re
import stat
import subprocess
import sys
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import SUBCOMMANDS, _find_needed_subcommands, main
from rotemina.sim.records import Record, Tap, read_record, write_record

HEADER = "t [s],x [mm],x.meas [mm]\n"
ROWS = "0,20.0,20.0\n0.01,20.01,20.0\n0.02,20.02,20.01\n0.03,20.03,20.02\n"


@pytest.fixture
def tour():
    shipped = resources.files("rotemina.resources.trajectories").joinpath("six_axis_tour.csv")
    with resources.as_file(shipped) as path:
        yield path


def test_play_then_compare_finds_only_noise(tour, capsys):
    assert main(["play", str(tour), "-o", "run.csv", "--seed", "3"]) == 0
    assert main(["compare", "run.csv", "--json", "out.json", "--plot", "out.svg"]) == 0
    document = json.loads(Path("out.json").read_text("utf-8"))
    assert document["format"] == "rotemina-comparison 1"
    measured = {tap["axis"]: tap for tap in document["taps"] if tap["tap"] == "meas"}
    assert list(measured) == ["x", "y", "z", "thx", "thy", "zn"]
    for axis in ("thx", "thy", "zn"):
        assert measured[axis]["rms"] == pytest.approx(measured[axis]["noise_floor"], rel=0.1)
    # An encoder at rest rounds to a constant, whose error can be anywhere around the noise floor.
    for axis in ("x", "y", "z"):
        assert 0.3 < measured[axis]["rms"] / measured[axis]["noise_floor"] < 1.4
    assert Path("out.svg").read_text("utf-8").startswith("<?xml")
    assert "thx.meas" in capsys.readouterr().out


def test_two_runs_are_compared_with_each_other(capsys):
    time_s = np.arange(2001) / 1000.0
    for name, lag_s in (("one", 0.0), ("two", 0.02)):
        position = 1e-5 * (1.0 - np.cos(2.0 * np.pi * (time_s - lag_s)))
        signals = {("zn", Tap.CMD): position, ("zn", Tap.MEAS): position + 1e-8}
        write_record(Record.from_signals(time_s + lag_s, signals, {"zn": "m"}), f"{name}.csv")
    assert main(["compare", "two.csv", "--with", "one.csv", "--json", "out.json"]) == 0
    (tap,) = json.loads(Path("out.json").read_text("utf-8"))["taps"]
    assert tap["delay_s"] == pytest.approx(0.02, abs=1e-4)
    assert tap["rms"] == pytest.approx(2e-5 * np.sin(0.02 * np.pi) / 2**0.5, rel=0.01)
    assert "tip path: the joints of a tip were not all measured" in capsys.readouterr().out
    assert main(["compare", "two.csv", "--with", "one.csv", "--fit", "gain"]) == 2
    assert "--fit re-fits the model" in capsys.readouterr().err


def write_trajectory(name, axis, time_s, command, unit="m"):
    record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit}, {"name": name})
    write_record(record, f"{name}.csv")
    return record


@pytest.mark.parametrize(
    ("robot", "axis", "centre", "rate_hz"),
    [("rotemina", "zn", 3e-5, 1000), ("rotemina", "zn", 3e-5, 70), ("emps", "q", 0.1, 300)],
)
def test_record_has_device_motion_and_requested_commands(robot, axis, centre, rate_hz):
    """Every requested row starts within a tick of its time. Sampling continues between rows."""
    time_s = 7.0 + np.arange(rate_hz + 1) / rate_hz
    command = centre * (1.0 + 0.05 * np.sin(np.pi * (time_s - 7.0)) ** 2)
    trajectory = write_trajectory("hum", axis, time_s, command)
    assert main(["play", "hum.csv", "--robot", robot, "--max-speed", "1m/s"]) == 0
    record = read_record("hum-record.csv")
    assert record.time_s[0] == 0.0
    assert np.diff(record.time_s).max() <= 1e-3 * (1 + 1e-9)
    assert len(record.time_s) >= 1001
    applied = record.signal(axis, Tap.CMD)
    changes = np.flatnonzero(np.diff(applied)) + 1
    for since_s, row in zip(time_s - 7.0, command, strict=True):
        index = np.searchsorted(record.time_s, since_s - 1e-9)
        assert record.time_s[index] - since_s <= 1e-3
        assert applied[index] == row
    assert len(changes) <= len(trajectory.time_s)
    assert record.metadata["driver"] == "simulator"
    assert record.metadata["trajectory"] == "hum"
    assert record.metadata["trajectory_rows"] == str(rate_hz + 1)
    assert float(record.metadata["trajectory_duration_s"]) == pytest.approx(1.0)


def test_record_of_short_trajectory_lists_its_times():
    write_trajectory("steps", "zn", np.array([0.0, 0.25, 1.0 / 3]), np.array([1e-5] * 3))
    assert main(["play", "steps.csv"]) == 0
    times = read_record("steps-record.csv").metadata["trajectory_times_s"]
    assert [float(text) for text in times.split()] == [0.0, 0.25, 1.0 / 3]


def test_same_seed_gives_same_record(tour):
    for name, seed in (("a.csv", "5"), ("b.csv", "5"), ("c.csv", "6")):
        assert main(["play", str(tour), "-o", name, "--seed", seed]) == 0
    assert Path("a.csv").read_bytes() == Path("b.csv").read_bytes()
    assert Path("a.csv").read_bytes() != Path("c.csv").read_bytes()


def test_controlled_robot_is_played_in_closed_loop():
    time_s = np.arange(2001) / 1000
    command = 0.05 + 0.02 * np.sin(np.pi * time_s) ** 2
    trajectory = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"})
    write_record(trajectory, "slow.csv")
    arguments = ["play", "slow.csv", "--robot", "emps", "--max-speed", "1m/s", "-o", "run.csv"]
    assert main(arguments) == 0
    record = read_record("run.csv")
    assert record.closed_loop
    assert np.ptp(record.signal("q", Tap.U)) > 0.1
    assert np.abs(record.signal("q", Tap.MEAS) - command).max() < 1e-3


def test_convert_changes_units_rate_and_header(capsys):
    Path("r.csv").write_text(HEADER + ROWS, "utf-8")
    assert main(["convert", "r.csv", "-o", "um.csv.gz", "--units", "um"]) == 0
    assert b"x.cmd [um]" in gzip.decompress(Path("um.csv.gz").read_bytes())
    assert main(["convert", "r.csv", "-o", "fast.csv", "--resample", "1000"]) == 0
    assert "X: 1 → 10 mm/s" in capsys.readouterr().out
    assert len(read_record("fast.csv").time_s) == 31
    assert main(["convert", "r.csv", "-o", "plain.txt", "--no-header"]) == 0
    assert Path("plain.txt").read_text("utf-8").splitlines()[0][0].isdigit()
    arguments = ["convert", "plain.txt", "-o", "again.csv", "--columns", "t [s], x [m], x.meas [m]"]
    assert main(arguments) == 0
    np.testing.assert_array_equal(read_record("again.csv").values, read_record("r.csv").values)


BAD_FILES = {
    "truncated": (HEADER + ROWS[:-8], r"r\.csv:5"),
    "wrong unit": (HEADER.replace("[mm]", "[kg]") + ROWS, r"unknown unit 'kg'"),
    "angle for a length": (HEADER.replace("mm", "urad") + ROWS, r"x"),
    "decimal comma": (HEADER + "0,0,20,0,20,0\n", r"r\.csv:2.*decimal signs"),
    "empty": ("", r"r\.csv"),
    "no rows": (HEADER, r"r\.csv"),
    "not a number": (HEADER + ROWS + "0.04,nan,20.0\n", r"r\.csv:6.*finite"),
    "time backwards": (HEADER + ROWS + "0.02,20.0,20.0\n", r"r\.csv:6.*increase"),
    "no header": (ROWS, r"columns"),
    "unknown axis": (HEADER.replace("x", "w") + ROWS, r"w"),
}


@pytest.mark.parametrize(
    ("command", "name"),
    [
        *(("compare r.csv", name) for name in BAD_FILES),
        ("play r.csv", "truncated"),
        ("convert r.csv -o out.csv", "truncated"),
    ],
)
def test_bad_file_is_refused(get_refusal, command, name):
    text, message = BAD_FILES[name]
    Path("r.csv").write_text(text, "utf-8")
    error = get_refusal(command)
    assert error.startswith("rotemina: r.csv")
    assert re.search(message, error), error


@pytest.mark.parametrize(
    "arguments",
    [
        "compare r.csv --json link.csv",
        "compare o.csv --with r.csv --json link.csv",
        "compare o.csv --plot out.svg --json ./out.svg",
        "play r.csv -o link.csv",
    ],
)
def test_no_output_overwrites_an_input_or_another_output(get_refusal, arguments):
    for name in ("r.csv", "o.csv"):
        Path(name).write_text(HEADER + ROWS, "utf-8")
    Path("link.csv").symlink_to("r.csv")
    assert "is named twice" in get_refusal(arguments)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("compare missing.csv", "missing.csv cannot be read"),
        ("compare .", "."),
        ("compare r.csv --robot nobody", "nobody: no such robot"),
        ("compare r.csv --fit speed", "'speed' cannot be re-fitted"),
        ("compare r.csv --plot out.bmp", "out.bmp: the name of a picture must end in"),
        ("compare r.csv --plot p.svg --json no/such/out.json", "cannot be written"),
        ("convert r.csv -o out.csv --units kg", "unknown unit 'kg'"),
        ("convert r.csv -o out.csv --units V", "a length or an angle"),
        ("convert r.csv -o out.csv --resample -5", "-5"),
        ("convert r.csv -o ./r.csv --units um", "r.csv"),
        ("convert r.csv -o out.csv --robot emps", "robot 'EMPS' has no axis 'x'"),
    ],
)
def test_bad_request_is_refused(get_refusal, arguments, message):
    Path("r.csv").write_text(HEADER + ROWS, "utf-8")
    Path("p.svg").write_text("old", "utf-8")
    assert message in get_refusal(arguments)


def test_trajectory_beyond_a_limit_is_not_played(get_refusal):
    Path("far.csv").write_text("t [s],x [mm]\n0,54.9\n1,55.3\n", "utf-8")
    error = get_refusal("play far.csv")
    assert error.startswith("rotemina: far.csv: axis x: ")
    assert "position 55.3 mm" in error
    assert "limit 55 mm" in error
    assert "(and 2 more)" in error
    # It can still be converted.
    assert main(["convert", "far.csv", "-o", "copy.csv"]) == 0


def test_trajectory_that_would_overshoot_the_range_is_not_played(get_refusal):
    Path("swing.csv").write_text("t [s],m1 [um]\n0,0\n0.001,4.9\n", "utf-8")
    assert "predicted motion" in get_refusal("play swing.csv --robot fsm")


def test_robot_option_can_precede_the_subcommand(capsys):
    Path("q.csv").write_text("t [s],q [m],q.u [V]\n0,0.1,0\n0.01,0.1,0\n", "utf-8")
    assert main(["--robot", "emps", "convert", "q.csv", "-o", "out.csv"]) == 0


def test_existing_record_is_not_overwritten(tour, get_refusal):
    Path("six_axis_tour-record.csv").write_text("mine", "utf-8")
    assert "six_axis_tour-record.csv" in get_refusal(["play", str(tour)])


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no named pipes in the file system")
def test_named_pipe_is_not_replaced_by_a_file(get_refusal):
    os.mkfifo("pipe")
    Path("r.csv").write_text(HEADER + ROWS, "utf-8")
    assert "pipe" in get_refusal("convert r.csv -o pipe")
    assert stat.S_ISFIFO(Path("pipe").stat().st_mode)


def test_dry_run_writes_nothing(tour, capsys):
    assert main(["play", str(tour), "--dry-run"]) == 0
    assert "within the limits" in capsys.readouterr().out
    assert not list(Path().iterdir())


def test_installed_command_prints_its_version():
    command = Path(sys.executable).with_name("rotemina")
    process = subprocess.run([command, "--version"], capture_output=True, text=True, check=True)
    assert process.stdout.startswith("rotemina ")


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ([], ()),
        (["--robot", "rotemina", "--set", "port=/dev/ttyUSB0", "--offscreen"], ()),
        (["gap", "diagnose", "run.csv"], ["gap"]),
        (["--language", "de", "play", "--help"], ["play"]),
        (["--help"], SUBCOMMANDS),
        (["--version"], SUBCOMMANDS),
        (["plya"], SUBCOMMANDS),  # the error message lists them all
        (["--robot"], SUBCOMMANDS),
        (["--language", "xx"], SUBCOMMANDS),
    ],
)
def test_only_named_subcommands_are_loaded(arguments, expected):
    assert _find_needed_subcommands(arguments) == expected
