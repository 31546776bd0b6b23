"""Labels, names, metadata and order do not change the diagnosis."""

import gzip
import json

import pytest

from rotemina.app.blind import CaseShard
from rotemina.app.blind.cases import FolderCaseSource
from rotemina.app.blind.diagnosis_process import diagnose_case
from rotemina.app.blind.resumable_run import ResumableBlindRun
from rotemina.sim.blind import draw_case, write_case
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow

ROBOT = load_robot("rotemina")
DRAWN_CASES = {"first": ("healthy", 1, None), "second": ("single", 6, "gain_error")}


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """Folder with generated cases, and the same cases with everything irrelevant changed."""
    folder = tmp_path_factory.mktemp("cases")
    labels = {}
    for name, (kind, seed, effect) in DRAWN_CASES.items():
        case = draw_case(ROBOT, kind, seed, effect)
        write_case(folder / "plain" / name, case, ROBOT)
        for path in (folder / "plain" / name).glob("train_*"):
            shorten_record(path)
        labels[name] = case.label()
    (folder / "plain.json").write_text(json.dumps(labels))
    for name, other in zip(DRAWN_CASES, reversed(DRAWN_CASES), strict=True):
        write_disguised_case(folder / "plain" / name, folder / "changed" / f"a_{other}_hysteresis")
    names = [f"a_{name}_hysteresis" for name in DRAWN_CASES]
    swapped = dict(zip(names, labels.values(), strict=True))
    (folder / "changed.json").write_text(json.dumps(swapped))
    return folder


def shorten_record(path):
    """Remove the second half of a record, so that the diagnosis is quick."""
    lines = gzip.decompress(path.read_bytes()).decode().splitlines(keepends=True)
    path.write_bytes(gzip.compress("".join(lines[: len(lines) // 2]).encode()))


def write_disguised_case(source, target):
    """Copy a case with its records in another order and with revealing metadata."""
    target.mkdir(parents=True)
    records = sorted(source.glob("train_*"))
    for number, path in enumerate(reversed(records), start=1):
        text = gzip.decompress(path.read_bytes()).decode()
        lines = text.replace("# mode", "# effect: hysteresis on every axis\n# mode", 1)
        (target / f"train_{number}.csv").write_text(lines)
    for path in source.glob("test_*"):
        (target / path.name).write_bytes(path.read_bytes())


def collect_answers(folder, subfolder, tmp_path):
    cases = FolderCaseSource(folder / subfolder, folder / f"{subfolder}.json", "rotemina")
    run = ResumableBlindRun(tmp_path / subfolder, cases)
    for name in run.list_pending(CaseShard()):
        run.run_case(name, diagnose_case)
    answers = {}
    for path in sorted((tmp_path / subfolder / "results").iterdir()):
        result = json.loads(path.read_text())
        answers[path.stem] = {**result["answer"], "held_out": result["held_out"]}
    return answers


def test_labels_names_metadata_and_order_do_not_change_the_answers(cases, tmp_path):
    plain = collect_answers(cases, "plain", tmp_path)
    changed = collect_answers(cases, "changed", tmp_path)
    assert plain["first"]["verdict"] == "none"
    assert plain["second"]["verdict"] != "none"
    assert plain["first"] == changed["a_second_hysteresis"]
    assert plain["second"] == changed["a_first_hysteresis"]
