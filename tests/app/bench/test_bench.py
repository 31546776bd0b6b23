"""The bench: machines in folders, what the diagnosis says of them beside what is known."""

import json
import shutil
import sys
from argparse import Namespace
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.bench.bench_run import result_of, run_bench
from rotemina.app.bench.machine import BenchError, Machine, Truth, machines
from rotemina.app.bench.residual import Residual, residual_of
from rotemina.app.bench.result import NamedCause, Result
from rotemina.app.bench.words import line, page
from rotemina.app.cli.main import main
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = """[robot]
name = "A table"
axes = ["q"]

[axis.q]
kind = "stepper"
range = [0.0, 0.01]
static = true
sensor.kind = "encoder"
sensor.resolution = 1.0e-8
sensor.noise_rms = 2.0e-8
"""
TRUTH = 'causes = [["backlash"]]\nto_beat = 1e-7\n'


def make_machine(folder, truth=TRUTH):
    folder.mkdir(parents=True)
    (folder / "robot.toml").write_text(ROBOT)
    if truth is not None:
        (folder / "truth.toml").write_text(truth)
    robot = load_robot(folder / "robot.toml")
    wrong = AxisEffect(axis="q", id="backlash", parameters={"width": 2e-5})
    time_s = np.arange(400) / 100.0
    for number, name in enumerate(("train_1", "train_2", "test_1"), start=1):
        command = 5e-3 + 1e-3 * np.sin(7.0 * number * time_s) * np.cos(1.7 * time_s)
        asked = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"})
        run = simulate(robot, [wrong], asked, np.random.default_rng(number))
        write_record(run, folder / f"{name}.csv")
    return folder


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    return make_machine(tmp_path_factory.mktemp("machines") / "table")


def of(named=(), before=1e-3, after=2e-5, seconds=5.0, **known):
    machine = Machine("table", Path("robot.toml"), (), (), Truth(**known))
    residuals = (Residual(gap, 1e-2, 1e-5) for gap in (before, after))
    causes = tuple(NamedCause("q", *one) for one in named)
    return Result(machine, "A table", "explained", causes, *residuals, seconds, "m")


def test_a_machine_is_diagnosed_and_tried_on_what_no_fit_saw(table, capsys, tmp_path):
    out, report = tmp_path / "out.json", tmp_path / "page.md"
    asked = ["gap", "bench", str(table), "--jobs", "1"]
    assert main([*asked, "--json", str(out), "--report", str(report)]) == 0
    told = capsys.readouterr().out
    assert told.startswith("table: backlash on q (")
    assert told.count("\n") == 1
    (found,) = json.loads(out.read_text())["machines"]
    assert found["first_is_right"]
    assert found["missed"] == found["not_reached"] == []
    assert found["left"] < 1e-7 < found["raw"]
    assert found["closed"] > 0.99
    assert "`table`" in report.read_text()
    assert "Nothing: every level is reached" in report.read_text()


def test_what_is_left_takes_off_offset_but_no_gain(table):
    robot = load_robot(table / "robot.toml")
    time_s = np.arange(400) / 100.0
    command = 5e-3 + 1e-3 * np.sin(time_s)
    signals = {("q", Tap.CMD): command, ("q", Tap.MEAS): 1.01 * command + 1e-4}
    record = Record.from_signals(time_s, signals, {"q": "m"})
    residual = residual_of(robot, [record], Tap.MEAS)
    assert residual.gap == pytest.approx(0.01 * np.std(command), rel=1e-3)
    assert residual.relative == pytest.approx(0.01 / 1.01, rel=1e-3)


def test_a_folder_of_machines_is_each_of_them(table, tmp_path):
    for name in ("b", "a"):
        shutil.copytree(table, tmp_path / name)
    (tmp_path / "licences").mkdir()
    assert [one.name for one in machines([tmp_path, table])] == ["a", "b", "table"]


def test_an_inverse_machine_is_told_and_not_run(table, tmp_path):
    shutil.copytree(table, tmp_path / "torque")
    first = tmp_path / "torque" / "train_1.csv"
    first.write_text("# mode: inverse\n" + first.read_text())
    (machine,) = machines([tmp_path])
    result = result_of(machine)
    assert line(result) == "torque: not run: inverse mode"
    assert "- `torque`: not run: inverse mode." in page([result])


def test_a_diagnosis_that_fails_or_lasts_ends_no_bench(table):
    (machine,) = machines([table])
    fails = result_of(machine, program=[sys.executable, "-c", "raise SystemExit('rotemina: so')"])
    assert fails.not_run == "so"
    waits = [sys.executable, "-c", "import threading; threading.Event().wait()"]
    lasts = result_of(machine, None, 0.2, waits)
    assert lasts.not_run == "it took longer than 0.2 s"


def test_without_truth_the_diagnosis_is_told_alone(tmp_path):
    (machine,) = machines([make_machine(tmp_path / "own", truth=None)])
    result = result_of(machine, 1)
    assert result.not_reached == []
    assert result.as_json()["known"] is None


@pytest.mark.parametrize(
    ("causes", "known", "said"),
    [
        ([("friction", 0.9, ())], {}, []),
        ([("backlash", 0.9, ("friction",))], {}, []),
        ([("delay", 0.9, ("friction", "backlash"))], {}, ["the first cause is delay, which"]),
        ([("friction", 0.9, ("a", "b", "c"))], {}, ["friction is not named"]),
        ([], {}, ["the first cause is none", "friction is not named"]),
        ([("delay", 0.9, ()), ("friction", 0.9, ())], {"also": ("delay",)}, []),
        ([("friction", 0.9, ())], {"to_beat": 1e-5}, ["it leaves 2 × the figure to beat"]),
    ],
)
def test_what_is_not_reached_is_said(causes, known, said):
    known = {"causes": (("friction",),), **known}
    if causes and causes[0][0] == "backlash":
        known["causes"] = (("friction", "backlash"),)
    told = of(causes, **known).not_reached
    assert len(told) == len(said)
    assert all(begin in each for begin, each in zip(said, told, strict=True))


def test_a_model_that_is_worse_and_a_diagnosis_that_lasts_are_said():
    told = of(after=2e-3, seconds=61.0).not_reached
    assert told == [
        "the corrected model is worse than the model as it was",
        "it takes 61 s, more than 60 s",
    ]


def test_a_set_of_all_that_stand_for_each_other_counts_however_large():
    four = ("leadscrew_error", "vibration", "encoder_interpolation", "microstep_error")
    assert of([(four[0], 0.9, four[1:])], causes=(four,)).not_reached == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("causes = ['friction']", "causes = ['friction']: must be a list of sets"),
        ("tap = 'cmd'", "tap = 'cmd': must be u, ref or meas"),
        ("to_beat = 0", "to_beat = 0: must be a number above 0"),
        ("cause = []", "cause = []: use causes, also, tap, relative, to_beat"),
        ("causes =", "truth.toml: not valid TOML"),
    ],
)
def test_a_truth_that_cannot_be_understood_is_refused(table, tmp_path, text, said):
    place = tmp_path / "m"
    shutil.copytree(table, place)
    (place / "truth.toml").write_text(text)
    with pytest.raises(BenchError) as caught:
        machines([place])
    assert said in str(caught.value)


def test_a_folder_without_a_machine_is_refused(tmp_path):
    with pytest.raises(BenchError, match=r"holds robot\.toml; name a machine's folder"):
        machines([tmp_path])
    (tmp_path / "robot.toml").write_text(ROBOT)
    with pytest.raises(BenchError, match="no record train_"):
        run_bench(Namespace(folders=[tmp_path], jobs=1, json=None, report=None, longest=1.0))
