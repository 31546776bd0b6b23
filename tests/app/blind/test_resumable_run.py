"""The run of the sealed test; the diagnosis is a small program made by hand here."""

import json
import sys
from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.blind.cases import BlindError, FolderCases, GeneratedCases
from rotemina.app.blind.closure import Gap, closure
from rotemina.app.blind.diagnosis_process import diagnose
from rotemina.app.blind.resumable_run import BlindRun
from rotemina.app.blind.shard import Shard
from rotemina.app.cli.main import main
from rotemina.sim.blind.sealing import SealError, digest
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record

# It sees its folder alone, answers by what the records hold, and tells what it saw.
DIAGNOSIS = """
import json, pathlib, sys
words = sys.argv[1:]
out = pathlib.Path(words[words.index("--json") + 1]) if "diagnose" in words else None
if out is None:
    source, target = words[2:5:2][0], words[words.index("-o") + 1]
    commands = pathlib.Path(words[3]).read_text().splitlines()
    head = [line for line in commands if not line.startswith("#")]
    name = head[0].split(",")[1]
    rows = [head[0] + "," + name.replace(".cmd", ".meas")]
    rows += [line + "," + line.split(",")[1] for line in head[1:]]
    pathlib.Path(target).write_text("\\n".join(rows) + "\\n")
    sys.exit()
seen = sorted(path.name for path in pathlib.Path().iterdir())
names = [word for word in words if word.startswith("record_")]
text = "".join(pathlib.Path(name).read_text() for name in names)
if "broken" in text:
    sys.exit("rotemina: it cannot")
cause = {"axis": "x", "effect": "creep", "from_axis": None, "probability": 0.9,
         "ambiguous_with": [], "closed": 0.9, "extra": 1}
verdict = "explained" if "creeping" in text else "none"
causes = [cause] if "creeping" in text else []
out.write_text(json.dumps({"verdict": verdict, "axes": {"x": verdict}, "causes": causes,
                           "why": [words, seen]}))
"""


@pytest.fixture
def program(tmp_path):
    file = tmp_path / "diagnosis_made_by_hand.py"
    file.write_text(DIAGNOSIS)
    return sys.executable, str(file)


@pytest.fixture
def ask(program):
    return lambda case: diagnose(case, program=program)


def write_own_case(folder, word=None):
    folder.mkdir(parents=True)
    time_s = np.arange(2500) * 1e-3
    command = 0.03 + 1e-4 * np.sin(5.0 * time_s)
    signals = {("x", Tap.CMD): command, ("x", Tap.MEAS): command + 1e-6 * np.cos(3.0 * time_s)}
    record = Record.from_signals(time_s, signals, {"x": "m"}, {"note": word or "plain"})
    write_record(record, folder / "train_1.csv")
    write_record(record, folder / "test_measured.csv")
    asked = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    write_record(asked, folder / "test_commands.csv")


CREEP = {
    "verdict": "explained",
    "effects": [{"axis": "x", "effect": "creep", "from_axis": None}],
}
NONE = {"verdict": "none", "effects": []}


@pytest.fixture
def own(tmp_path):
    folder = tmp_path / "own"
    write_own_case(folder / "alpha", "creeping")
    write_own_case(folder / "beta")
    labels = tmp_path / "labels.json"
    labels.write_text(json.dumps({"alpha": CREEP, "beta": NONE}))
    return FolderCases(folder, labels, "rotemina")


def results(folder):
    return {p.stem: json.loads(p.read_text()) for p in sorted((folder / "results").iterdir())}


def test_the_diagnosis_sees_records_alone_under_names_that_tell_nothing(own, ask):
    with own.sealed("alpha", "salt") as case:
        answer = ask(case)
    words, seen = answer.document["why"]
    assert seen == ["record_1.csv"]
    assert words[:3] == ["gap", "diagnose", "record_1.csv"]
    assert "alpha" not in " ".join(words)
    assert words[words.index("--robot") + 1] == "rotemina"
    assert answer.sha256 == digest(json.dumps(answer.document).encode())


def test_labels_are_sealed_first_and_opened_when_all_answers_are_hashed(tmp_path, own, ask):
    run = BlindRun(tmp_path / "out", own)
    for name in run.pending(Shard()):
        run.do(name, ask)
        committed = json.loads((tmp_path / "out" / "commitments" / f"{name}.json").read_text())
        assert results(tmp_path / "out")[name]["commitment"] == committed["sha256"]
    assert all("label" not in result for result in results(tmp_path / "out").values())
    assert run.outcomes() == []
    run.open_labels()
    assert [outcome.right for outcome in run.outcomes()] == [True, True]
    alpha = run.outcomes()[0]
    assert alpha.closure == 0.0  # the predicted record is the command: nothing is closed
    assert "extra" not in alpha.answer["causes"][0]


def test_labels_that_change_after_they_were_sealed_are_refused(tmp_path, own, ask):
    run = BlindRun(tmp_path / "out", own)
    run.do("alpha", ask)
    labels = tmp_path / "labels.json"
    labels.write_text(labels.read_text().replace("creep", "delay"))
    with pytest.raises(SealError, match="its label is not the one that was sealed"):
        run.open_labels()


def test_what_is_done_is_not_done_again_and_shards_share_the_rest(tmp_path, own, ask):
    run = BlindRun(tmp_path / "out", own)
    assert [run.pending(Shard(i, 2)) for i in (1, 2)] == [["alpha"], ["beta"]]
    run.do("alpha", ask)
    assert BlindRun(tmp_path / "out", own).pending(Shard()) == ["beta"]


def test_an_interrupted_case_leaves_no_result(tmp_path, own):
    def interrupted(case):
        raise KeyboardInterrupt

    run = BlindRun(tmp_path / "out", own)
    with pytest.raises(KeyboardInterrupt):
        run.do("alpha", interrupted)
    assert results(tmp_path / "out") == {}
    assert run.pending(Shard()) == ["alpha", "beta"]


def test_results_of_other_cases_are_not_mixed_in(tmp_path, own):
    BlindRun(tmp_path / "out", own)
    other = GeneratedCases("rotemina", 2, 1)
    with pytest.raises(BlindError, match="it holds the results of other cases"):
        BlindRun(tmp_path / "out", other)


@pytest.mark.parametrize(("text", "said"), [("{", "not valid JSON"), ("{}", "it is no result")])
def test_a_result_that_is_none_is_said(tmp_path, own, text, said):
    run = BlindRun(tmp_path / "out", own)
    (tmp_path / "out" / "results" / "alpha.json").write_text(text)
    with pytest.raises(BlindError, match=said):
        run.outcomes()


def test_a_diagnosis_that_fails_is_an_answer_that_is_wrong(tmp_path, own, ask):
    write_own_case(tmp_path / "more" / "gamma", "broken")
    cases = FolderCases(tmp_path / "more", own._labels, "rotemina")
    with cases.sealed("gamma", "salt") as case:
        answer = ask(case)
    assert answer.document == {"verdict": "failed", "why": "exit status 1: rotemina: it cannot"}
    assert answer.predicted is None


def test_a_generated_label_is_opened_with_its_answer(tmp_path, ask):
    cases = GeneratedCases("rotemina", 1, 4)
    run = BlindRun(tmp_path / "out", cases)
    run.do("case_0000", lambda case: ask(replace(case, records=case.records[:0], commands=None)))
    (result,) = results(tmp_path / "out").values()
    assert set(result["label"]) >= {"verdict", "effects", "kind", "floors"}
    assert result["answer"]["verdict"] == "none"
    assert len(run.outcomes()) == 1


def test_closure_is_told_of_the_axes_with_a_gap_that_can_be_predicted():
    gaps = {"x": Gap(3.0, 1.0, 1.0), "y": Gap(5.0, 5.0, 1.0), "z": Gap(1.02, 1.0, 1.0)}
    assert closure(gaps, {"x": ["creep"]}) == pytest.approx(1.0)
    assert closure(gaps, {"x": ["creep"], "y": ["delay"]}) == pytest.approx(8.0 / 32.0)
    assert closure(gaps, {"y": ["sensor_noise"]}) is None
    assert closure(gaps, {"z": ["delay"]}) is None
    assert closure(gaps, {"q": ["delay"]}) is None


@pytest.mark.parametrize(
    ("labels", "said"),
    [
        ("{", "not valid JSON"),
        ("{}", "it has no label of alpha"),
        ('{"alpha": {"verdict": "fine"}}', "verdict is 'fine'; it must be one of explained"),
        ('{"alpha": {"verdict": "explained", "effects": []}}', "effects must be a list"),
        ('{"alpha": {"verdict": "none", "effects": [3]}}', "effects must be a list"),
        ('{"alpha": {"verdict": "none", "floors": "many"}}', "floors is 'many'; it must be"),
    ],
)
def test_labels_that_cannot_be_understood_are_said(tmp_path, ask, labels, said):
    write_own_case(tmp_path / "own" / "alpha")
    file = tmp_path / "labels.json"
    file.write_text(labels)
    run = BlindRun(tmp_path / "out", FolderCases(tmp_path / "own", file, "rotemina"))
    run.do("alpha", ask)
    with pytest.raises(BlindError, match=said):
        run.open_labels()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--shard", "3/2"], "must be I/N"),
        (["--from", "own"], "--from DIR and --labels FILE belong together"),
        (["--from", "nowhere", "--labels", "l.json"], "nowhere: there is no such folder"),
        (["--from", ".", "--labels", "l.json"], "no folder in it holds records"),
        (["--from", "own", "--labels", "l.json"], "l.json cannot be read"),
        (["--from", "own", "--labels", "l.json", "--cases", "3"], "all cases of the folder"),
        (["--cases", "0"], "at least 1 case"),
        (["--robot", "picma"], "no cases can be made of it"),
    ],
)
def test_what_cannot_be_run_is_said_in_one_line(tmp_path, monkeypatch, capsys, words, said):
    write_own_case(tmp_path / "own" / "alpha")
    monkeypatch.chdir(tmp_path)
    try:
        status = main(["gap", "blind", *words])
    except SystemExit as leaving:
        status = leaving.code
    assert status == 2
    assert said in capsys.readouterr().err
    assert not list(tmp_path.glob("rotemina-blind*"))


def test_the_command_scores_ones_own_cases(tmp_path, monkeypatch, capsys, own, program):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        "rotemina.app.blind.self_test.diagnose",
        lambda case, jobs: diagnose(case, jobs, program=program),
    )
    words = ["gap", "blind", "--from", "own", "--labels", "labels.json"]
    words += ["--json", "out.json", "--report", "page.md", "--folder", "run"]
    assert main(words) == 0
    assert "first cause correct" in capsys.readouterr().out
    document = json.loads((tmp_path / "out.json").read_text())
    assert document["done"] == document["asked"] == 2
    assert document["figures"]["top_1"]["value"] == 1.0
    assert document["wrong"] == []
    assert "page.svg" in (tmp_path / "page.md").read_text()
    assert (tmp_path / "page.svg").exists()
    next((tmp_path / "run" / "results").glob("*.json")).unlink()
    assert main([*words, "--score"]) == 0
    document = json.loads((tmp_path / "out.json").read_text())
    assert (document["done"], document["asked"]) == (1, 2)
    assert "1 of 2 cases of labels `" in (tmp_path / "page.md").read_text()


@pytest.mark.parametrize(
    ("option", "seed", "said"),
    [
        ("--report", 999, "seeds below 1000 are for development; report cases of a seed from 1000"),
        ("--calibrate", 1000, "seeds from 1000 on are for reports; calibrate on one below 1000"),
    ],
)
def test_development_and_reported_seeds_are_never_the_same(option, seed, said, tmp_path, capsys):
    asked = ["gap", "blind", "--cases", "1", "--folder", str(tmp_path / "run")]
    assert main([*asked, "--seed", str(seed), option, str(tmp_path / "out.md")]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "run").exists()
