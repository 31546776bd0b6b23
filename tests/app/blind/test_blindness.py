"""Labels, names, metadata and order change no answer of the diagnosis."""

import gzip
import json

import pytest

from rotemina.app.blind.cases import FolderCases
from rotemina.app.blind.diagnosis_process import diagnose
from rotemina.app.blind.resumable_run import BlindRun
from rotemina.app.blind.shard import Shard
from rotemina.sim.blind.case import draw_case
from rotemina.sim.blind.files import write_case
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow

ROBOT = load_robot("rotemina")
DRAWN = {"first": ("healthy", 1, None), "second": ("single", 6, "gain_error")}


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """Cases as the generator writes them, and the same with all changed that may not count."""
    folder = tmp_path_factory.mktemp("cases")
    labels = {}
    for name, (kind, seed, effect) in DRAWN.items():
        case = draw_case(ROBOT, kind, seed, effect)
        write_case(folder / "plain" / name, case, ROBOT)
        labels[name] = case.label()
    (folder / "plain.json").write_text(json.dumps(labels))
    for name, other in zip(DRAWN, reversed(DRAWN), strict=True):
        disguise(folder / "plain" / name, folder / "changed" / f"a_{other}_hysteresis")
    names = [f"a_{name}_hysteresis" for name in DRAWN]
    swapped = dict(zip(names, labels.values(), strict=True))
    (folder / "changed.json").write_text(json.dumps(swapped))
    return folder


def disguise(source, target):
    """Copy a case with its records in another order, and with talkative metadata."""
    target.mkdir(parents=True)
    records = sorted(source.glob("train_*"))
    for number, path in enumerate(reversed(records), start=1):
        text = gzip.decompress(path.read_bytes()).decode()
        lines = text.replace("# mode", "# effect: hysteresis on every axis\n# mode", 1)
        (target / f"train_{number}.csv").write_text(lines)
    for path in source.glob("test_*"):
        (target / path.name).write_bytes(path.read_bytes())


def answers(folder, which, tmp_path):
    cases = FolderCases(folder / which, folder / f"{which}.json", "rotemina")
    run = BlindRun(tmp_path / which, cases)
    for name in run.pending(Shard()):
        run.do(name, diagnose)
    found = {}
    for path in sorted((tmp_path / which / "results").iterdir()):
        result = json.loads(path.read_text())
        found[path.stem] = {**result["answer"], "held_out": result["held_out"]}
    return found


def test_labels_names_metadata_and_order_change_no_answer(cases, tmp_path):
    plain = answers(cases, "plain", tmp_path)
    changed = answers(cases, "changed", tmp_path)
    assert plain["first"]["verdict"] == "none"
    assert plain["first"] == changed["a_second_hysteresis"]
    assert plain["second"] == changed["a_first_hysteresis"]
