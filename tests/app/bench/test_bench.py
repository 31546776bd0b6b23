"""The bench compares the diagnoses of machines in folders with the known causes."""

import json
import shutil
import sys
from argparse import Namespace
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.bench import run_bench
from rotemina.app.bench.bench_run import diagnose_machine
from rotemina.app.bench.machine import BenchMachine, KnownCauses, find_machines
from rotemina.app.bench.residual import ModelResidual, compute_model_residual
from rotemina.app.bench.result import BenchResult, NamedCause
from rotemina.app.bench.words import format_line, format_page
from rotemina.app.cli.main import main
from rotemina.app.errors import BenchError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot


def make_bench_result(named=(), before=1e-3, after=2e-5, seconds=5.0, **known):
    machine = BenchMachine("table", Path("robot.toml"), (), (), KnownCauses(**known))
    residuals = (ModelResidual(gap, 1e-2, 1e-5) for gap in (before, after))
    causes = tuple(NamedCause("q", *cause) for cause in named)
    return BenchResult(machine, "A table", "explained", causes, *residuals, seconds, "m")


def test_machine_is_diagnosed_and_checked_on_held_out_records(machine_folder, capsys, tmp_path):
    out, report = tmp_path / "out.json", tmp_path / "page.md"
    arguments = ["gap", "bench", str(machine_folder), "--jobs", "1"]
    assert main([*arguments, "--json", str(out), "--report", str(report)]) == 0
    output = capsys.readouterr().out
    assert output.startswith("table: backlash on q (")
    assert output.count("\n") == 1
    (result,) = json.loads(out.read_text())["machines"]
    assert result["first_is_right"]
    assert result["missed"] == result["not_reached"] == []
    assert result["left"] < 1e-7 < result["raw"]
    assert result["closed"] > 0.99
    assert "`table`" in report.read_text()
    assert "Nothing: every level is reached" in report.read_text()


def test_residual_ignores_offset_but_not_gain(machine_folder):
    robot = load_robot(machine_folder / "robot.toml")
    time_s = np.arange(400) / 100.0
    command = 5e-3 + 1e-3 * np.sin(time_s)
    signals = {("q", Tap.CMD): command, ("q", Tap.MEAS): 1.01 * command + 1e-4}
    record = Record.from_signals(time_s, signals, {"q": "m"})
    residual = compute_model_residual(robot, [record], Tap.MEAS)
    assert residual.gap == pytest.approx(0.01 * np.std(command), rel=1e-3)
    assert residual.relative == pytest.approx(0.01 / 1.01, rel=1e-3)


def test_folder_of_machines_yields_each_machine(machine_folder, tmp_path):
    for name in ("b", "a"):
        shutil.copytree(machine_folder, tmp_path / name)
    (tmp_path / "licences").mkdir()
    assert [machine.name for machine in find_machines([tmp_path, machine_folder])] == [
        "a",
        "b",
        "table",
    ]


def test_inverse_machine_is_reported_and_not_run(machine_folder, tmp_path):
    shutil.copytree(machine_folder, tmp_path / "torque")
    first_record = tmp_path / "torque" / "train_1.csv"
    first_record.write_text("# mode: inverse\n" + first_record.read_text())
    (machine,) = find_machines([tmp_path])
    result = diagnose_machine(machine)
    assert format_line(result) == "torque: not run: inverse mode"
    assert "- `torque`: not run: inverse mode." in format_page([result])


def test_failing_or_slow_diagnosis_does_not_end_the_bench(machine_folder):
    (machine,) = find_machines([machine_folder])
    failed_result = diagnose_machine(
        machine, program=[sys.executable, "-c", "raise SystemExit('rotemina: so')"]
    )
    assert failed_result.not_run == "so"
    waiting_program = [sys.executable, "-c", "import threading; threading.Event().wait()"]
    timed_out_result = diagnose_machine(machine, None, 0.2, waiting_program)
    assert timed_out_result.not_run == "it took longer than 0.2 s"


def test_without_truth_file_only_the_diagnosis_is_reported(make_machine, tmp_path):
    (machine,) = find_machines([make_machine(tmp_path / "own", truth=None)])
    result = diagnose_machine(machine, 1)
    assert result.unmet_requirements == []
    assert result.as_json()["known"] is None


@pytest.mark.parametrize(
    ("causes", "known", "messages"),
    [
        ([("friction", 0.9, ())], {}, []),
        ([("backlash", 0.9, ("friction",))], {}, []),
        ([("delay", 0.9, ("friction", "backlash"))], {}, ["the first cause is delay, which"]),
        ([("friction", 0.9, ("a", "b", "c"))], {}, ["friction is not named"]),
        ([], {}, ["the first cause is none", "friction is not named"]),
        ([("delay", 0.9, ()), ("friction", 0.9, ())], {"optional_effects": ("delay",)}, []),
        ([("friction", 0.9, ())], {"to_beat": 1e-5}, ["it leaves 2 × the figure to beat"]),
    ],
)
def test_unmet_requirements_are_reported(causes, known, messages):
    known = {"causes": (("friction",),), **known}
    if causes and causes[0][0] == "backlash":
        known["causes"] = (("friction", "backlash"),)
    requirements = make_bench_result(causes, **known).unmet_requirements
    assert len(requirements) == len(messages)
    assert all(
        message in requirement for message, requirement in zip(messages, requirements, strict=True)
    )


def test_worse_model_and_slow_diagnosis_are_reported():
    requirements = make_bench_result(after=2e-3, seconds=61.0).unmet_requirements
    assert requirements == [
        "the corrected model is worse than the original one",
        "the diagnosis takes 61 s, more than 60 s",
    ]


def test_known_set_of_confusable_causes_counts_at_any_size():
    effects = ("leadscrew_error", "vibration", "encoder_interpolation", "microstep_error")
    assert (
        make_bench_result([(effects[0], 0.9, effects[1:])], causes=(effects,)).unmet_requirements
        == []
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("causes = ['friction']", "causes = ['friction']: must be a list of sets"),
        ("tap = 'cmd'", "tap = 'cmd': must be u, ref or meas"),
        ("to_beat = 0", "to_beat = 0: must be a number above 0"),
        ("cause = []", "cause = []: use causes, also, tap, relative, to_beat"),
        ("causes =", "truth.toml: not valid TOML"),
    ],
)
def test_unreadable_truth_file_is_refused(machine_folder, tmp_path, text, message):
    folder = tmp_path / "m"
    shutil.copytree(machine_folder, folder)
    (folder / "truth.toml").write_text(text)
    with pytest.raises(BenchError) as error_info:
        find_machines([folder])
    assert message in str(error_info.value)


def test_folder_without_machine_is_refused(machine_folder, tmp_path):
    with pytest.raises(BenchError, match=r"no robot\.toml in it .*; name the folder of a machine"):
        find_machines([tmp_path])
    shutil.copyfile(machine_folder / "robot.toml", tmp_path / "robot.toml")
    with pytest.raises(BenchError, match="no record train_"):
        run_bench(Namespace(folders=[tmp_path]))
