"""The run of the sealed test, with a small handwritten program as the diagnosis."""

import json
import sys
from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.blind import CaseShard
from rotemina.app.blind.cases import FolderCaseSource, GeneratedCaseSource
from rotemina.app.blind.closure import HeldOutGap, compute_closure
from rotemina.app.blind.diagnosis_process import diagnose_case
from rotemina.app.blind.resumable_run import ResumableBlindRun
from rotemina.app.cli.main import main
from rotemina.app.errors import BlindError
from rotemina.sim.blind import compute_digest
from rotemina.sim.errors import SealError
from rotemina.sim.records import Record, Tap, write_record

# It sees only its folder, answers according to the records, and reports what it saw.
DIAGNOSIS_PROGRAM = """
import json, pathlib, sys
arguments = sys.argv[1:]
out = None
if "diagnose" in arguments:
    out = pathlib.Path(arguments[arguments.index("--json") + 1])
if out is None:
    source, target = arguments[2:5:2][0], arguments[arguments.index("-o") + 1]
    commands = pathlib.Path(arguments[3]).read_text().splitlines()
    head = [line for line in commands if not line.startswith("#")]
    name = head[0].split(",")[1]
    rows = [head[0] + "," + name.replace(".cmd", ".meas")]
    rows += [line + "," + line.split(",")[1] for line in head[1:]]
    pathlib.Path(target).write_text("\\n".join(rows) + "\\n")
    sys.exit()
files = sorted(path.name for path in pathlib.Path().iterdir())
names = [argument for argument in arguments if argument.startswith("record_")]
text = "".join(pathlib.Path(name).read_text() for name in names)
if "broken" in text:
    sys.exit("rotemina: it cannot")
cause = {"axis": "x", "effect": "creep", "from_axis": None, "probability": 0.9,
         "ambiguous_with": [], "closed": 0.9, "extra": 1}
verdict = "explained" if "creeping" in text else "none"
causes = [cause] if "creeping" in text else []
out.write_text(json.dumps({"verdict": verdict, "axes": {"x": verdict}, "causes": causes,
                           "why": [arguments, files]}))
"""


@pytest.fixture
def program(tmp_path):
    file = tmp_path / "diagnosis_made_by_hand.py"
    file.write_text(DIAGNOSIS_PROGRAM)
    return sys.executable, str(file)


@pytest.fixture
def diagnose(program):
    return lambda case: diagnose_case(case, program=program)


def write_handwritten_case(folder, word=None):
    folder.mkdir(parents=True)
    time_s = np.arange(2500) * 1e-3
    command = 0.03 + 1e-4 * np.sin(5.0 * time_s)
    signals = {("x", Tap.CMD): command, ("x", Tap.MEAS): command + 1e-6 * np.cos(3.0 * time_s)}
    record = Record.from_signals(time_s, signals, {"x": "m"}, {"note": word or "plain"})
    write_record(record, folder / "train_1.csv")
    write_record(record, folder / "test_measured.csv")
    commands = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    write_record(commands, folder / "test_commands.csv")


CREEP = {
    "verdict": "explained",
    "effects": [{"axis": "x", "effect": "creep", "from_axis": None}],
}
HEALTHY = {"verdict": "none", "effects": []}


@pytest.fixture
def case_source(tmp_path):
    folder = tmp_path / "own"
    write_handwritten_case(folder / "alpha", "creeping")
    write_handwritten_case(folder / "beta")
    labels = tmp_path / "labels.json"
    labels.write_text(json.dumps({"alpha": CREEP, "beta": HEALTHY}))
    return FolderCaseSource(folder, labels, "rotemina")


def read_results(folder):
    return {p.stem: json.loads(p.read_text()) for p in sorted((folder / "results").iterdir())}


def test_diagnosis_sees_only_records_with_neutral_names(case_source, diagnose):
    with case_source.open_case("alpha", "salt") as case:
        answer = diagnose(case)
    arguments, files = answer.document["why"]
    assert files == ["record_1.csv"]
    assert arguments[:3] == ["gap", "diagnose", "record_1.csv"]
    assert "alpha" not in " ".join(arguments)
    assert arguments[arguments.index("--robot") + 1] == "rotemina"
    assert answer.sha256 == compute_digest(json.dumps(answer.document).encode())


def test_labels_are_sealed_first_and_opened_after_all_answers_are_hashed(
    tmp_path, case_source, diagnose
):
    run = ResumableBlindRun(tmp_path / "out", case_source)
    for name in run.list_pending(CaseShard()):
        run.run_case(name, diagnose)
        commitment = json.loads((tmp_path / "out" / "commitments" / f"{name}.json").read_text())
        assert read_results(tmp_path / "out")[name]["commitment"] == commitment["sha256"]
    assert all("label" not in result for result in read_results(tmp_path / "out").values())
    assert run.read_outcomes() == []
    run.open_labels()
    assert [outcome.is_correct for outcome in run.read_outcomes()] == [True, True]
    alpha = run.read_outcomes()[0]
    assert alpha.closure == 0.0  # the predicted record is the command: nothing is closed
    assert "extra" not in alpha.answer["causes"][0]


def test_labels_changed_after_sealing_are_refused(tmp_path, case_source, diagnose):
    run = ResumableBlindRun(tmp_path / "out", case_source)
    run.run_case("alpha", diagnose)
    labels = tmp_path / "labels.json"
    labels.write_text(labels.read_text().replace("creep", "delay"))
    with pytest.raises(SealError, match="its label is not the one that was sealed"):
        run.open_labels()


def test_finished_cases_are_skipped_and_shards_share_the_rest(tmp_path, case_source, diagnose):
    run = ResumableBlindRun(tmp_path / "out", case_source)
    assert [run.list_pending(CaseShard(i, 2)) for i in (1, 2)] == [["alpha"], ["beta"]]
    run.run_case("alpha", diagnose)
    assert ResumableBlindRun(tmp_path / "out", case_source).list_pending(CaseShard()) == ["beta"]


def test_an_interrupted_case_leaves_no_result(tmp_path, case_source):
    def interrupt(case):
        raise KeyboardInterrupt

    run = ResumableBlindRun(tmp_path / "out", case_source)
    with pytest.raises(KeyboardInterrupt):
        run.run_case("alpha", interrupt)
    assert read_results(tmp_path / "out") == {}
    assert run.list_pending(CaseShard()) == ["alpha", "beta"]


def test_folder_with_results_of_other_cases_is_refused(tmp_path, case_source):
    ResumableBlindRun(tmp_path / "out", case_source)
    other = GeneratedCaseSource("rotemina", 2, 1)
    with pytest.raises(BlindError, match="holds the results of other cases"):
        ResumableBlindRun(tmp_path / "out", other)


@pytest.mark.parametrize(("text", "message"), [("{", "not valid JSON"), ("{}", "not a result")])
def test_invalid_result_file_is_reported(tmp_path, case_source, text, message):
    run = ResumableBlindRun(tmp_path / "out", case_source)
    (tmp_path / "out" / "results" / "alpha.json").write_text(text)
    with pytest.raises(BlindError, match=message):
        run.read_outcomes()


def test_failing_diagnosis_gives_a_failed_answer(tmp_path, case_source, diagnose):
    write_handwritten_case(tmp_path / "more" / "gamma", "broken")
    cases = FolderCaseSource(tmp_path / "more", case_source._labels, "rotemina")
    with cases.open_case("gamma", "salt") as case:
        answer = diagnose(case)
    assert answer.document == {"verdict": "failed", "why": "it cannot"}
    assert answer.predicted is None


def test_generated_label_is_opened_with_its_answer(tmp_path, diagnose):
    cases = GeneratedCaseSource("rotemina", 1, 4)
    run = ResumableBlindRun(tmp_path / "out", cases)
    run.run_case(
        "case_0000", lambda case: diagnose(replace(case, records=case.records[:0], commands=None))
    )
    (result,) = read_results(tmp_path / "out").values()
    assert set(result["label"]) >= {"verdict", "effects", "kind", "floors"}
    assert result["answer"]["verdict"] == "none"
    assert len(run.read_outcomes()) == 1


def test_closure_counts_only_axes_with_a_predictable_gap():
    gaps = {
        "x": HeldOutGap(3.0, 1.0, 1.0),
        "y": HeldOutGap(5.0, 5.0, 1.0),
        "z": HeldOutGap(1.02, 1.0, 1.0),
    }
    assert compute_closure(gaps, {"x": ["creep"]}) == pytest.approx(1.0)
    assert compute_closure(gaps, {"x": ["creep"], "y": ["delay"]}) == pytest.approx(8.0 / 32.0)
    assert compute_closure(gaps, {"y": ["sensor_noise"]}) is None
    assert compute_closure(gaps, {"z": ["delay"]}) is None
    assert compute_closure(gaps, {"q": ["delay"]}) is None


@pytest.mark.parametrize(
    ("labels", "message"),
    [
        ("{", "not valid JSON"),
        ("{}", "has no label for alpha"),
        ('{"alpha": {"verdict": "fine"}}', "verdict is 'fine'; it must be one of explained"),
        ('{"alpha": {"verdict": "none", "effects": [3]}}', "effects must be a list"),
        ('{"alpha": {"verdict": "none", "floors": "many"}}', "floors is 'many'; it must be"),
    ],
)
def test_invalid_labels_are_reported(tmp_path, diagnose, labels, message):
    write_handwritten_case(tmp_path / "own" / "alpha")
    file = tmp_path / "labels.json"
    file.write_text(labels)
    run = ResumableBlindRun(tmp_path / "out", FolderCaseSource(tmp_path / "own", file, "rotemina"))
    run.run_case("alpha", diagnose)
    with pytest.raises(BlindError, match=message):
        run.open_labels()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--shard", "3/2"], "must be I/N"),
        (["--from", "own"], "--from DIR and --labels FILE belong together"),
        (["--from", "nowhere", "--labels", "l.json"], "nowhere: folder not found"),
        (["--from", ".", "--labels", "l.json"], "no subfolder has records"),
        (["--from", "own", "--labels", "l.json"], "l.json cannot be read"),
        (["--from", "own", "--labels", "l.json", "--cases", "3"], "all cases of the folder"),
        (["--cases", "0"], "at least 1 case"),
        (["--robot", "picma"], "cannot make cases of this robot"),
    ],
)
def test_impossible_run_is_refused_with_a_message(
    tmp_path, monkeypatch, capsys, arguments, message
):
    write_handwritten_case(tmp_path / "own" / "alpha")
    monkeypatch.chdir(tmp_path)
    try:
        status = main(["gap", "blind", *arguments])
    except SystemExit as error:
        status = error.code
    assert status == 2
    assert message in capsys.readouterr().err
    assert not list(tmp_path.glob("rotemina-blind*"))


def test_command_scores_cases_of_a_folder(tmp_path, monkeypatch, capsys, case_source, program):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        "rotemina.app.blind.self_test.diagnose_case",
        lambda case, jobs: diagnose_case(case, jobs, program=program),
    )
    arguments = ["gap", "blind", "--from", "own", "--labels", "labels.json"]
    arguments += ["--json", "out.json", "--report", "page.md", "--folder", "run"]
    assert main(arguments) == 0
    assert "first cause correct" in capsys.readouterr().out
    document = json.loads((tmp_path / "out.json").read_text())
    assert document["done"] == document["asked"] == 2
    assert document["figures"]["top_1"]["value"] == 1.0
    assert document["wrong"] == []
    assert "page.svg" in (tmp_path / "page.md").read_text()
    assert (tmp_path / "page.svg").exists()
    next((tmp_path / "run" / "results").glob("*.json")).unlink()
    assert main([*arguments, "--score"]) == 0
    document = json.loads((tmp_path / "out.json").read_text())
    assert (document["done"], document["asked"]) == (1, 2)
    assert "1 of 2 cases of labels `" in (tmp_path / "page.md").read_text()


@pytest.mark.parametrize(
    ("option", "seed", "message"),
    [
        ("--report", 999, "seeds below 1000 are for development; use a seed from 1000"),
        (
            "--calibrate",
            1000,
            "seeds from 1000 on are for reports; calibrate with a seed below 1000",
        ),
    ],
)
def test_development_and_reported_seeds_are_never_the_same(option, seed, message, tmp_path, capsys):
    arguments = ["gap", "blind", "--cases", "1", "--folder", str(tmp_path / "run")]
    assert main([*arguments, "--seed", str(seed), option, str(tmp_path / "out.md")]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "run").exists()
