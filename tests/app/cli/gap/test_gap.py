"""``rotemina gap`` from the command line, with a handwritten diagnosis."""

import contextlib
import io
import json
import sys
import types
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.gap import gap_diagnose
from rotemina.app.cli.main import main
from rotemina.app.cli.terminal import TerminalProgressLine
from rotemina.sim.errors import GapError
from rotemina.sim.gap.result import Grade, Progress
from rotemina.sim.gap.result.ranking import Standings
from rotemina.sim.records import Record, Tap, read_record, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, read_robot_file
from rotemina.sim.simulation import simulate
from rotemina.sim.trajectory import dry_run

ROBOT = load_robot("rotemina")


@pytest.fixture
def diagnosis_calls(monkeypatch, made_diagnosis):
    """Replace the diagnosis by a handwritten result and return the list of its calls."""
    calls = []

    def diagnose(robot, records, *, seed, jobs, listener, cautions):
        calls.append(types.SimpleNamespace(robot=robot, records=records, seed=seed, jobs=jobs))
        listener(Progress("where", "thx", None, 0.5))
        return made_diagnosis

    monkeypatch.setattr(gap_diagnose, "run_diagnosis", diagnose)
    return calls


def write_measured(name="r.csv", seconds=1.0, rate_hz=1000.0, axes=("thx",), seed=0):
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    swing = 0.5 - 0.2 * np.cos(2.0 * np.pi * 3.0 * time_s)
    signals = {(axis, Tap.CMD): min(ROBOT.axes[axis].span, 1e-3) * swing for axis in axes}
    commands = Record.from_signals(time_s, signals, {axis: ROBOT.unit(axis) for axis in axes})
    write_record(simulate(ROBOT, (), commands, np.random.default_rng(seed)), name)


def list_files():
    return sorted(path.name for path in Path().iterdir())


def test_diagnose_reads_all_records_and_prints_a_summary(diagnosis_calls, capsys):
    write_measured("a.csv")
    write_measured("b.csv.gz", rate_hz=500.0, axes=("thx", "zn", "y"), seed=1)
    assert main(["gap", "diagnose", "a.csv", "b.csv.gz", "--seed", "7", "--jobs", "2"]) == 0
    [call] = diagnosis_calls
    assert (call.robot, call.seed, call.jobs) == (ROBOT, 7, 2)
    assert [record.axes for record in call.records] == [("thx",), ("thx", "zn", "y")]
    output = capsys.readouterr().out
    for text in (
        "RoTeMiNa: no known effect explains the gap",
        "  thx: explained\n    The rest depends on time.",
        "  thx.ref: 63.5 % (61 % … 65.7 %) of it; rms 1.418 µrad, noise floor 0.1 µrad;",
        "; mostly between 0.5 and 4 Hz; largest in: reversal",
        "  thx: hysteresis (actuator), probability 0.91; closes 98 % (97 % … 99 %);",
        "rms 32 µrad without it, 0.76 µrad with it",
        "    not distinguishable from: creep",
        "    width = 120 µrad (110 µrad … 130 µrad), at its high bound",
        "    shape = 4",
        "  y: an unknown effect, probability 0.90; rms 80 nm\n",
        "  experiment 1, on thx: A step and a long rest",
    ):
        assert text in output
    assert list_files() == ["a.csv", "b.csv.gz"]


def write_record_with_taps(name, axes, taps=(Tap.CMD, Tap.MEAS)):
    """Write a record that has only the given taps."""
    write_measured(name, axes=axes, seed=2)
    record = read_record(name)
    signals = {column: record.signal(*column) for column in record.columns if column.tap in taps}
    write_record(Record.from_signals(record.time_s, signals, record.units), name)


def test_cautions_are_printed_once_and_name_their_files(diagnosis_calls, capsys):
    write_measured("a.csv")
    write_record_with_taps("b.csv", ("x", "zn"))
    record = read_record("a.csv")
    kept_rows = np.delete(np.arange(1000), [300])
    write_record(
        Record(record.time_s[kept_rows], record.columns, record.values[kept_rows], record.units),
        "a.csv",
    )
    assert main(["gap", "diagnose", "a.csv", "b.csv"]) == 0
    assert capsys.readouterr().err.splitlines()[:3] == [
        "Model: RoTeMiNa (built in); choose another with --robot",
        "rotemina: a.csv: Rows are missing at 1 places of a record; the commands are assumed "
        "constant there.",
        "rotemina: x, zn: No independent reference (ref) was recorded: effects of the sensor "
        "cannot be distinguished from those of the axis.",
    ]


def test_unusable_records_are_refused_and_named(diagnosis_calls, capsys):
    write_measured("a.csv")
    write_measured("b.csv")
    assert main(["gap", "diagnose", "a.csv", "b.csv", "--json", "out.json"]) == 2
    assert capsys.readouterr().err == (
        "rotemina: b.csv: it contains the same measurements as a.csv (thx.ref); give each record "
        "once, and parts of one record without overlap\n"
    )
    assert not diagnosis_calls
    write_record_with_taps("c.csv", ("x",), taps=(Tap.CMD,))
    assert main(["gap", "diagnose", "c.csv"]) == 2
    assert capsys.readouterr().err.startswith("rotemina: c.csv: no measured channel (u, ref or")


def test_playable_experiments_are_written_next_to_the_document(diagnosis_calls, capsys):
    write_measured()
    Path("to").mkdir()
    assert main(["gap", "diagnose", "r.csv", "--json", "to/out.json"]) == 0
    assert capsys.readouterr().out.startswith("RoTeMiNa: ")
    document = json.loads(Path("to/out.json").read_text("utf-8"))
    assert document["format"] == "rotemina-diagnosis 1"
    [experiment] = document["next_experiments"]
    assert experiment["commands"] == "out_experiment_1.csv"
    assert sorted(path.name for path in Path("to").iterdir()) == [
        "out.json",
        "out_experiment_1.csv",
        "out_experiment_1_if_creep.csv",
        "out_experiment_1_if_hysteresis.csv",
    ]
    trajectory = read_record("to/out_experiment_1.csv", robot=ROBOT)
    assert [str(column) for column in trajectory.columns] == ["thx.cmd"]
    assert trajectory.metadata["splits"] == "hysteresis, creep on thx"
    assert dry_run(ROBOT, trajectory).allowed
    prediction = read_record("to/" + experiment["predictions"]["creep"])
    assert prediction.signal("thx", Tap.MEAS) == pytest.approx(
        0.97 * prediction.signal("thx", Tap.CMD)
    )


def test_stdout_has_only_the_json(diagnosis_calls, capsys):
    write_measured()
    assert main(["gap", "diagnose", "r.csv", "--json", "-"]) == 0
    output = capsys.readouterr()
    document = json.loads(output.out)
    assert document["next_experiments"][0]["commands"] is None
    assert "suggested experiments are written next to a JSON file" in output.err
    assert list_files() == ["r.csv"]


def test_report_is_a_page_that_names_the_records(diagnosis_calls, capsys):
    write_measured("first.csv")
    outputs = ["--report", "out.html", "--json", "out.json"]
    assert main(["gap", "diagnose", "first.csv", *outputs]) == 0
    page = Path("out.html").read_text("utf-8")
    assert page.startswith("<!DOCTYPE html>")
    assert "first.csv" in page
    assert Path("out.json").exists()


def raise_gap_error(*_, **__):
    raise GapError("axis 'thx': no record holds a measured channel of it")


def raise_interrupt(*_, **__):
    raise KeyboardInterrupt


def test_failed_diagnosis_gives_one_clear_line_and_no_file(diagnosis_calls, monkeypatch, capsys):
    write_measured()
    monkeypatch.setattr(gap_diagnose, "run_diagnosis", raise_gap_error)
    assert main(["gap", "diagnose", "r.csv", "--json", "out.json"]) == 2
    assert capsys.readouterr().err == (
        "Model: RoTeMiNa (built in); choose another with --robot\n"
        "rotemina: axis 'thx': no record holds a measured channel of it\n"
    )
    assert list_files() == ["r.csv"]


def test_interrupt_leaves_no_file_and_status_130(monkeypatch, capsys):
    write_measured()
    monkeypatch.setattr(gap_diagnose, "run_diagnosis", raise_interrupt)
    assert main(["gap", "diagnose", "r.csv", "--json", "out.json"]) == 130
    assert capsys.readouterr().err.splitlines()[-1] == "rotemina: interrupted"
    assert list_files() == ["r.csv"]


def test_unwritable_report_leaves_no_document(diagnosis_calls, capsys):
    write_measured()
    Path("out.html").mkdir()
    outputs = ["--report", "out.html", "--json", "out.json"]
    assert main(["gap", "diagnose", "r.csv", *outputs]) == 2
    assert "out.html is a folder; name a file in it" in capsys.readouterr().err
    assert list_files() == ["out.html", "r.csv"]


@pytest.mark.parametrize("function", ["_make_record_file", "make_report"])
def test_files_are_written_together_or_not_at_all(diagnosis_calls, monkeypatch, function):
    write_measured()
    monkeypatch.setattr(gap_diagnose, function, raise_interrupt)
    outputs = ["--report", "out.html", "--json", "out.json"]
    assert main(["gap", "diagnose", "r.csv", *outputs]) == 130
    assert list_files() == ["r.csv"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("diagnose none.csv", "none.csv"),
        ("diagnose r.csv --robot nobody", "nobody: no such robot"),
        ("diagnose r.csv --robot picma", "robot 'PICMA P-885.91' has no axis 'thx'"),
        ("diagnose r.csv --seed -1", "--seed -1: must be 0 or more"),
        ("diagnose r.csv --jobs 0", "--jobs 0: must be 1 or more"),
        ("diagnose r.csv --robot own.toml --json own.toml", "own.toml is named twice"),
        ("diagnose r.csv --report ./r.csv", "r.csv is named twice"),
        ("diagnose r.csv --json o.html --report ./o.html", "o.html is named twice"),
        ("diagnose r.csv --json no/out", "no/out cannot be written: there is no folder"),
        ("diagnose r.csv --report no/out", "no/out cannot be written: there is no folder"),
        (
            "diagnose o_experiment_1.csv --json o.json",
            "would be overwritten by a suggested experiment of o.json",
        ),
        ("predict none.json r.csv", "none.json cannot be read"),
        ("predict r.csv r.csv", "r.csv:1: not valid JSON"),
        ("twin r.csv -o r.csv", "r.csv is named twice"),
        ("", "name a subcommand: check, diagnose, predict"),
    ],
)
def test_bad_request_gives_one_clear_line_and_status_2(diagnosis_calls, arguments, message, capsys):
    write_measured()
    write_measured("o_experiment_1.csv")
    Path("own.toml").write_text(read_robot_file("rotemina"), "utf-8")
    before = list_files()
    assert main(["gap", *arguments.split()]) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert error.startswith("rotemina: ")
    assert message in error
    assert list_files() == before
    assert not diagnosis_calls


@pytest.fixture
def document(diagnosis_calls):
    write_measured()
    assert main(["gap", "diagnose", "r.csv", "--json", "out.json"]) == 0
    return "out.json"


def test_predict_needs_no_other_file(document, made_diagnosis, capsys):
    commands = Record.from_signals(
        np.arange(800) / 1000.0,
        {("thx", Tap.CMD): 6e-4 + 1e-4 * np.sin(np.arange(800) / 50.0)},
        {"thx": "rad"},
    )
    write_record(commands, "c.csv", units={"thx": "urad"})
    Path("r.csv").unlink()
    capsys.readouterr()
    assert main(["gap", "predict", document, "c.csv"]) == 0
    assert capsys.readouterr().out == "c-predicted.csv: 800 rows, 0.799 s\n"
    predicted = read_record("c-predicted.csv", robot=ROBOT)
    corrected = replace(ROBOT, effects=made_diagnosis.fitted)
    expected = simulate(corrected, None, read_record("c.csv"))
    assert np.array_equal(predicted.values, expected.values)
    assert main(["gap", "predict", document, "c.csv"]) == 2
    assert "c-predicted.csv already exists" in capsys.readouterr().err
    assert main(["gap", "predict", document, "c.csv", "-o", "c.csv"]) == 2
    assert "c.csv is named twice" in capsys.readouterr().err
    Path("c.csv").write_text("t [s],w [mm]\n0,1\n1,2\n")
    assert main(["gap", "predict", document, "c.csv", "-o", "d.csv"]) == 2
    assert "robot 'RoTeMiNa' has no axis 'w'" in capsys.readouterr().err


def test_twin_is_a_robot_file_that_other_commands_accept(document, made_diagnosis, capsys):
    capsys.readouterr()
    assert main(["gap", "twin", document, "-o", "twin.toml"]) == 0
    assert capsys.readouterr().out == (
        "twin.toml: robot RoTeMiNa with gain_error on axis thx, hysteresis on axis thx, "
        "cross_coupling on axis thx\n"
    )
    assert load_robot("twin.toml").effects == made_diagnosis.fitted
    assert "# [paper] 240 arcsec" in Path("twin.toml").read_text("utf-8")
    assert main(["simulate", "r.csv", "--robot", "twin.toml", "--no-noise", "-o", "s.csv"]) == 0
    assert main(["gap", "predict", document, "r.csv", "-o", "p.csv"]) == 0
    assert np.array_equal(read_record("s.csv").values, read_record("p.csv").values)
    assert main(["gap", "twin", document, "-o", "twin.toml"]) == 2
    assert "twin.toml already exists" in capsys.readouterr().err
    assert main(["gap", "twin", document, "-o", "t.toml", "--robot", "picma"]) == 2
    assert "picma: this file does not describe the diagnosed robot" in capsys.readouterr().err
    assert not Path("t.toml").exists()


class Terminal(io.StringIO):
    def isatty(self):
        return True


def write_progress(stream, steps):
    """Show ``steps`` (time, share) on a progress line and return the text it wrote."""
    times = iter([0.0, *(time_s for time_s, _ in steps)])
    with TerminalProgressLine(stream, clock=lambda: next(times)) as line:
        for _, share in steps:
            line(Progress("fitting", "thx", "creep", share))
    return stream.getvalue()


def test_terminal_gets_one_rewritten_line():
    text = write_progress(Terminal(), [(0.01, 0.0), (0.02, 0.1), (4.0, 0.2), (4.05, 0.3)])
    assert text == (
        "\rfitting thx creep, 0 %\x1b[K\rfitting thx creep, 20 %, about 16 s left\x1b[K\n"
    )


def test_log_gets_a_line_every_few_seconds():
    steps = [(0.1 * number, number / 200.0) for number in range(1, 120)]
    assert write_progress(io.StringIO(), steps).splitlines() == [
        "fitting thx creep, 25 %, about 15 s left",
        "fitting thx creep, 50 %, about 10 s left",
    ]


def test_progress_names_the_leading_candidate():
    standings = Standings("thx")
    standings.begin(101.0)
    for name, residual in (("hysteresis", 11.0), ("creep", 31.0)):
        standings.add([AxisEffect(axis="thx", id=name)], residual, Grade.LOOK)
    stream = Terminal()
    with TerminalProgressLine(stream, clock=lambda: 0.0) as line:
        line(Progress("screening", "thx", None, 0.2, standings.ranking()))
    assert "screening thx, 20 %, hysteresis first of 2: 90 % closed" in stream.getvalue()


def fail_after_a_step(stream):
    with TerminalProgressLine(stream) as line:
        line(Progress("where", None, None, 0.0))
        raise GapError("no")


def test_started_line_is_ended_before_an_error():
    stream = Terminal()
    with pytest.raises(GapError):
        fail_after_a_step(stream)
    assert stream.getvalue() == "\rwhere, 0 %\x1b[K\n"


def fail_to_connect(address, timeout):
    raise OSError(f"timed out trying to connect to {address}")


class ClientWithoutWorkers(contextlib.nullcontext):
    def __init__(self, address, timeout):
        super().__init__()

    def wait_for_workers(self, count, timeout):
        raise TimeoutError


@pytest.mark.parametrize(
    ("client", "message"),
    [
        (None, "pip install 'rotemina[dask]'"),
        (fail_to_connect, "--cluster tcp://host:8786 cannot be reached"),
        (ClientWithoutWorkers, "--cluster tcp://host:8786 has no workers"),
    ],
)
def test_unusable_cluster_is_reported(monkeypatch, capsys, diagnosis_calls, client, message):
    write_measured()
    module = client and types.SimpleNamespace(Client=client, KilledWorker=RuntimeError)
    monkeypatch.setitem(sys.modules, "distributed", module)
    assert main(["gap", "diagnose", "r.csv", "--cluster", "tcp://host:8786"]) == 2
    assert message in capsys.readouterr().err
    assert not diagnosis_calls
