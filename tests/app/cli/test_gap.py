"""``rotemina gap`` as its users meet it; the diagnosis itself is made by hand here."""

import contextlib
import io
import json
import sys
import types
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli import gap_diagnose
from rotemina.app.cli.main import main
from rotemina.app.cli.progress import ProgressLine
from rotemina.sim.gap.compare.diagnosis_progress import Progress
from rotemina.sim.gap.compare.ranking import Grade, Standings
from rotemina.sim.gap.errors import GapError
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import SHIPPED, load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate
from rotemina.sim.trajectory.dry_run import dry_run

ROBOT = load_robot("rotemina")


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def asked(monkeypatch, made_diagnosis):
    """What the diagnosis was asked for, while it answers with one made by hand."""
    calls = []

    def diagnose(robot, records, *, seed, jobs, listener, cautions):
        calls.append(types.SimpleNamespace(robot=robot, records=records, seed=seed, jobs=jobs))
        listener(Progress("where", "thx", None, 0.5))
        return made_diagnosis

    monkeypatch.setattr(gap_diagnose, "diagnose", diagnose)
    return calls


def write_measured(name="r.csv", seconds=1.0, rate_hz=1000.0, axes=("thx",), seed=0):
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    turn = 0.5 - 0.2 * np.cos(2.0 * np.pi * 3.0 * time_s)
    signals = {(axis, Tap.CMD): min(ROBOT.axes[axis].span, 1e-3) * turn for axis in axes}
    commands = Record.from_signals(time_s, signals, {axis: ROBOT.unit(axis) for axis in axes})
    write_record(simulate(ROBOT, (), commands, np.random.default_rng(seed)), name)


def files():
    return sorted(path.name for path in Path().iterdir())


def test_diagnose_reads_all_records_and_prints_a_summary(asked, capsys):
    write_measured("a.csv")
    write_measured("b.csv.gz", rate_hz=500.0, axes=("thx", "zn", "y"), seed=1)
    assert main(["gap", "diagnose", "a.csv", "b.csv.gz", "--seed", "7", "--jobs", "2"]) == 0
    [call] = asked
    assert (call.robot, call.seed, call.jobs) == (ROBOT, 7, 2)
    assert [record.axes for record in call.records] == [("thx",), ("thx", "zn", "y")]
    said = capsys.readouterr().out
    for words in (
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
        assert words in said
    assert files() == ["a.csv", "b.csv.gz"]


def bare(name, axes, keep=(Tap.CMD, Tap.MEAS)):
    """A record of some taps alone."""
    write_measured(name, axes=axes, seed=2)
    record = read_record(name)
    signals = {each: record.signal(*each) for each in record.columns if each.tap in keep}
    write_record(Record.from_signals(record.time_s, signals, record.units), name)


def test_cautions_are_told_once_for_all_axes_and_files_are_named(asked, capsys):
    write_measured("a.csv")
    bare("b.csv", ("x", "zn"))
    short = read_record("a.csv")
    kept = np.delete(np.arange(1000), [300])
    write_record(
        Record(short.time_s[kept], short.columns, short.values[kept], short.units), "a.csv"
    )
    assert main(["gap", "diagnose", "a.csv", "b.csv"]) == 0
    assert capsys.readouterr().err.splitlines()[:3] == [
        "Model: RoTeMiNa (built in); choose another with --robot",
        "rotemina: a.csv: Rows are missing at 1 places of a record; the commands are assumed "
        "constant there.",
        "rotemina: x, zn: No independent reference (ref) was recorded: effects of the sensor "
        "cannot be distinguished from those of the axis.",
    ]


def test_records_that_cannot_be_diagnosed_are_refused_with_their_file(asked, capsys):
    write_measured("a.csv")
    write_measured("b.csv")
    assert main(["gap", "diagnose", "a.csv", "b.csv", "--json", "out.json"]) == 2
    assert capsys.readouterr().err == (
        "rotemina: b.csv: it holds measurements of a.csv again (thx.ref); give each record once, "
        "and parts of one record without overlap\n"
    )
    assert not asked
    bare("c.csv", ("x",), keep=(Tap.CMD,))
    assert main(["gap", "diagnose", "c.csv"]) == 2
    assert capsys.readouterr().err.startswith("rotemina: c.csv: no measured channel (u, ref or")


def test_jobs_are_by_default_the_usable_cores(asked):
    import joblib

    write_measured()
    assert main(["gap", "diagnose", "r.csv"]) == 0
    assert asked[0].jobs == joblib.cpu_count()


def test_a_document_has_playable_experiments_beside_it(asked, capsys):
    write_measured()
    Path("to").mkdir()
    assert main(["gap", "diagnose", "r.csv", "--json", "to/out.json"]) == 0
    assert capsys.readouterr().out.startswith("RoTeMiNa: ")
    form = json.loads(Path("to/out.json").read_text("utf-8"))
    assert form["format"] == "rotemina-diagnosis 1"
    [experiment] = form["next_experiments"]
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
    rival = read_record("to/" + experiment["predictions"]["creep"])
    assert rival.signal("thx", Tap.MEAS) == pytest.approx(0.97 * rival.signal("thx", Tap.CMD))


def test_json_on_stdout_is_json_alone(asked, capsys):
    write_measured()
    assert main(["gap", "diagnose", "r.csv", "--json", "-"]) == 0
    said = capsys.readouterr()
    form = json.loads(said.out)
    assert form["next_experiments"][0]["commands"] is None
    assert "suggested experiments are written beside a JSON file" in said.err
    assert files() == ["r.csv"]


def test_a_report_is_a_page_with_the_names_of_the_records(asked, capsys):
    write_measured("first.csv")
    asked_for = ["--report", "out.html", "--json", "out.json"]
    assert main(["gap", "diagnose", "first.csv", *asked_for]) == 0
    page = Path("out.html").read_text("utf-8")
    assert page.startswith("<!DOCTYPE html>")
    assert "first.csv" in page
    assert Path("out.json").exists()


def refuse(*_, **__):
    raise GapError("axis 'thx': no record holds a measured channel of it")


def interrupt(*_, **__):
    raise KeyboardInterrupt


def test_what_cannot_be_diagnosed_is_one_clear_line_and_no_file(asked, monkeypatch, capsys):
    write_measured()
    monkeypatch.setattr(gap_diagnose, "diagnose", refuse)
    assert main(["gap", "diagnose", "r.csv", "--json", "out.json"]) == 2
    assert capsys.readouterr().err == (
        "Model: RoTeMiNa (built in); choose another with --robot\n"
        "rotemina: axis 'thx': no record holds a measured channel of it\n"
    )
    assert files() == ["r.csv"]


def test_an_interrupt_leaves_no_file_and_status_130(monkeypatch, capsys):
    write_measured()
    monkeypatch.setattr(gap_diagnose, "diagnose", interrupt)
    assert main(["gap", "diagnose", "r.csv", "--json", "out.json"]) == 130
    assert capsys.readouterr().err.splitlines()[-1] == "rotemina: interrupted"
    assert files() == ["r.csv"]


@pytest.mark.parametrize("part", ["_file_of", "report"])
def test_files_appear_together_or_none(asked, monkeypatch, part):
    write_measured()
    monkeypatch.setattr(gap_diagnose, part, interrupt)
    asked_for = ["--report", "out.html", "--json", "out.json"]
    assert main(["gap", "diagnose", "r.csv", *asked_for]) == 130
    assert files() == ["r.csv"]


def test_a_report_that_cannot_be_written_leaves_no_document(asked, capsys):
    write_measured()
    Path("out.html").mkdir()
    asked_for = ["--report", "out.html", "--json", "out.json"]
    assert main(["gap", "diagnose", "r.csv", *asked_for]) == 2
    assert "out.html is a folder; name a file in it" in capsys.readouterr().err
    assert files() == ["out.html", "r.csv"]


def test_a_folder_that_is_missing_is_said_before_the_work(asked, capsys):
    write_measured()
    for option in ("--json", "--report"):
        assert main(["gap", "diagnose", "r.csv", option, "no/such/out"]) == 2
        assert "no/such/out cannot be written: there is no folder" in capsys.readouterr().err
    assert not asked


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("diagnose none.csv", "none.csv"),
        ("diagnose r.csv --robot nobody", "nobody: no such robot"),
        ("diagnose r.csv --robot picma", "robot 'PICMA P-885.91' has no axis 'thx'"),
        ("diagnose r.csv --seed -1", "--seed -1: must be 0 or more"),
        ("diagnose r.csv --jobs 0", "--jobs 0: must be 1 or more"),
        ("diagnose r.csv --json ./r.csv", "r.csv is named twice"),
        ("diagnose r.csv --robot own.toml --json own.toml", "own.toml is named twice"),
        ("diagnose r.csv --report r.csv", "r.csv is named twice"),
        ("diagnose r.csv --json o.html --report ./o.html", "o.html is named twice"),
        ("diagnose r.csv --json no/such/out.json", "no/such/out.json cannot be written"),
        (
            "diagnose o_experiment_1.csv --json o.json",
            "would be overwritten by a suggested experiment of o.json",
        ),
        ("predict none.json r.csv", "none.json cannot be read"),
        ("predict r.csv r.csv", "r.csv:1: not valid JSON"),
        ("twin none.json -o t.toml", "none.json cannot be read"),
        ("", "name a subcommand: diagnose, predict"),
    ],
)
def test_a_bad_request_is_one_clear_line_and_status_2(asked, arguments, message, capsys):
    write_measured()
    write_measured("o_experiment_1.csv")
    shipped = resources.files(SHIPPED).joinpath("rotemina.toml").read_text("utf-8")
    Path("own.toml").write_text(shipped, "utf-8")
    before = files()
    assert main(["gap", *arguments.split()]) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert error.startswith("rotemina: ")
    assert message in error
    assert files() == before


@pytest.fixture
def document(asked):
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
    found = read_record("c-predicted.csv", robot=ROBOT)
    corrected = replace(ROBOT, effects=made_diagnosis.fitted)
    expected = simulate(corrected, None, read_record("c.csv"))
    assert np.array_equal(found.values, expected.values)
    assert main(["gap", "predict", document, "c.csv"]) == 2
    assert "c-predicted.csv already exists" in capsys.readouterr().err
    assert main(["gap", "predict", document, "c.csv", "-o", "c.csv"]) == 2
    assert "c.csv is named twice" in capsys.readouterr().err


def test_predict_refuses_commands_of_another_robot(document, capsys):
    Path("c.csv").write_text("t [s],w [mm]\n0,1\n1,2\n")
    assert main(["gap", "predict", document, "c.csv"]) == 2
    assert "robot 'RoTeMiNa' has no axis 'w'" in capsys.readouterr().err


def test_a_twin_is_a_robot_file_that_every_command_takes(document, made_diagnosis, capsys):
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
    assert "picma: it describes another robot" in capsys.readouterr().err
    assert not Path("t.toml").exists()


class Terminal(io.StringIO):
    def isatty(self):
        return True


def tell(stream, steps):
    """Let a line tell of ``steps`` (time, share), and return what it wrote."""
    times = iter([0.0, *(time_s for time_s, _ in steps)])
    with ProgressLine(stream, clock=lambda: next(times)) as line:
        for _, share in steps:
            line(Progress("fitting", "thx", "creep", share))
    return stream.getvalue()


def test_a_terminal_sees_one_line_that_is_rewritten():
    said = tell(Terminal(), [(0.01, 0.0), (0.02, 0.1), (4.0, 0.2), (4.05, 0.3)])
    assert said == (
        "\rfitting thx creep, 0 %\x1b[K\rfitting thx creep, 20 %, about 16 s left\x1b[K\n"
    )


def test_a_log_sees_a_line_every_few_seconds():
    steps = [(0.1 * number, number / 200.0) for number in range(1, 120)]
    assert tell(io.StringIO(), steps).splitlines() == [
        "fitting thx creep, 25 %, about 15 s left",
        "fitting thx creep, 50 %, about 10 s left",
    ]


def test_the_candidate_that_leads_is_told():
    standings = Standings("thx")
    standings.begin(101.0)
    for name, left in (("hysteresis", 11.0), ("creep", 31.0)):
        standings.add([AxisEffect(axis="thx", id=name)], left, Grade.LOOK)
    stream = Terminal()
    with ProgressLine(stream, clock=lambda: 0.0) as line:
        line(Progress("screening", "thx", None, 0.2, standings.ranking()))
    assert "screening thx, 20 %, hysteresis first of 2: 90 % closed" in stream.getvalue()


def fail_after_a_step(stream):
    with ProgressLine(stream) as line:
        line(Progress("where", None, None, 0.0))
        raise GapError("no")


def test_a_line_that_was_begun_is_ended_before_an_error():
    stream = Terminal()
    with pytest.raises(GapError):
        fail_after_a_step(stream)
    assert stream.getvalue() == "\rwhere, 0 %\x1b[K\n"


def test_a_cluster_needs_its_extra(monkeypatch, capsys, asked):
    write_measured()
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["gap", "diagnose", "r.csv", "--cluster", "tcp://host:8786"]) == 2
    assert "pip install 'rotemina[dask]'" in capsys.readouterr().err


def test_a_cluster_that_does_not_answer_is_said(monkeypatch, capsys, asked):
    def client(address, timeout):
        raise OSError(f"timed out trying to connect to {address}")

    write_measured()
    distributed = types.SimpleNamespace(Client=client, KilledWorker=RuntimeError)
    monkeypatch.setitem(sys.modules, "distributed", distributed)
    assert main(["gap", "diagnose", "r.csv", "--cluster", "tcp://host:8786"]) == 2
    assert "--cluster tcp://host:8786 cannot be reached" in capsys.readouterr().err
    assert not asked


def test_a_cluster_without_workers_is_said(monkeypatch, capsys, asked):
    class Client(contextlib.nullcontext):
        def __init__(self, address, timeout):
            super().__init__()

        def wait_for_workers(self, count, timeout):
            raise TimeoutError

    write_measured()
    distributed = types.SimpleNamespace(Client=Client, KilledWorker=RuntimeError)
    monkeypatch.setitem(sys.modules, "distributed", distributed)
    assert main(["gap", "diagnose", "r.csv", "--cluster", "tcp://host:8786"]) == 2
    assert "--cluster tcp://host:8786 has no workers" in capsys.readouterr().err
    assert not asked
