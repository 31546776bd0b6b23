"""Two versions of the diagnosis answer the same cases, side by side."""

import json
import shlex
import shutil
import sys

import pytest

from rotemina.app.bench.engine_comparison import (
    EngineAnswers,
    describe_answer,
    format_difference,
    format_summary,
)
from rotemina.app.cli.main import main

# Another version: it calls this one, and renames the cause.
OTHER_PROGRAM = """
import json, pathlib, sys
from rotemina.app.cli.main import main
status = main(sys.argv[1:])
if "diagnose" in sys.argv:
    path = pathlib.Path(sys.argv[sys.argv.index("--json") + 1])
    document = json.loads(path.read_text())
    document["causes"][0]["effect"] = "friction"
    path.write_text(json.dumps(document))
sys.exit(status)
"""


def make_document(*causes, verdict="explained"):
    return {
        "verdict": verdict,
        "axes": {"x": verdict},
        "causes": [
            {"axis": "x", "effect": effects[0], "ambiguous_with": effects[1:], "probability": 0.9}
            for effects in causes
        ],
    }


def test_answers_differ_by_verdict_causes_order_and_sets_but_not_by_order_in_a_set():
    answer = describe_answer(make_document(["delay"], ["backlash", "friction"]))
    assert answer == "x:explained; {delay} on x, {backlash friction} on x"
    assert describe_answer(make_document(["delay"], ["friction", "backlash"])) == answer
    for other in (
        make_document(["backlash", "friction"], ["delay"]),
        make_document(["delay"], ["backlash"]),
        make_document(["delay"]),
        make_document(["delay"], ["backlash", "friction"], verdict="partly"),
    ):
        assert describe_answer(other) != answer
    assert describe_answer({"verdict": "failed"}) == "failed; no cause"


def test_the_summary_names_the_cases_that_differ_and_compares_processor_time():
    same = EngineAnswers("a", "x:none; no cause", "x:none; no cause", 2.0, 3.0)
    different = EngineAnswers("b", "one", "two", 1.0, 3.0, "{backlash}")
    assert format_difference(same) == "a: both x:none; no cause"
    assert format_difference(different) == "b: this one (right: {backlash})\nb: other two"
    assert format_summary([same, different]).splitlines() == [
        "1 of 2 cases differ: b",
        "processor time: this 3.0 s, other 6.0 s, 0.50 times as much",
    ]


@pytest.fixture
def other_program(tmp_path):
    """Return the command of the other version."""
    path = tmp_path / "other.py"
    path.write_text(OTHER_PROGRAM)
    return shlex.join([sys.executable, str(path)])


@pytest.mark.slow
def test_the_bench_shows_the_machines_on_which_two_versions_differ(
    machine_folder, other_program, tmp_path, capsys
):
    output = tmp_path / "bench.json"
    arguments = ["gap", "bench", str(machine_folder), "--json", str(output)]
    assert main([*arguments, "--against", other_program]) == 0
    text = capsys.readouterr().out
    assert "table: this q:explained; {backlash} on q (right: {backlash})" in text
    assert "table: other q:explained; {friction} on q" in text
    (answers,) = json.loads(output.read_text("utf-8"))["against"]
    assert answers["differs"]
    assert min(answers["own_processor_s"], answers["other_processor_s"]) > 0.1


@pytest.mark.slow
def test_the_blind_test_compares_two_versions_on_the_same_cases(
    machine_folder, other_program, tmp_path, monkeypatch, capsys
):
    case = tmp_path / "cases" / "first"
    case.mkdir(parents=True)
    for name in ("train_1.csv", "train_2.csv"):
        shutil.copyfile(machine_folder / name, case / name)
    effect = {"axis": "q", "effect": "backlash", "from_axis": None}
    labels = {"first": {"verdict": "explained", "effects": [effect]}}
    (tmp_path / "labels.json").write_text(json.dumps(labels))
    monkeypatch.chdir(tmp_path)
    arguments = ["gap", "blind", "--from", "cases", "--labels", "labels.json", "--folder", "run"]
    arguments += ["--robot", str(machine_folder / "robot.toml"), "--json", "out.json"]
    assert main([*arguments, "--against", other_program]) == 0
    text = capsys.readouterr().out
    assert "first: this q:explained; {backlash} on q (right: backlash on q)" in text
    assert "first: other q:explained; {friction} on q" in text
    assert "1 of 1 cases differ: first" in text
    figures = json.loads((tmp_path / "out.json").read_text("utf-8"))["figures"]
    assert figures["top_1"]["value"] == 1.0


@pytest.mark.parametrize("command", ["/no/such/program", "", "'not closed"])
def test_a_program_that_cannot_be_run_is_refused(command, tmp_path, capsys):
    with pytest.raises(SystemExit) as refusal:
        main(["gap", "bench", str(tmp_path), "--against", command])
    assert refusal.value.code == 2
    assert "--against" in capsys.readouterr().err
