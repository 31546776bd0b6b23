"""The example cases with answers: the right effects on the right axes."""

import json

import pytest

from rotemina.sim.gap.compare.diagnosis_progress import Account
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.examination import examine
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("number", range(1, 9))
def test_an_example_is_diagnosed_right(shared_dir, number):
    folder = shared_dir / "examples" / f"example_{number}"
    answer = json.loads((folder / "answer.json").read_text(encoding="utf-8"))
    robot = load_robot("rotemina")
    records = [read_record(path, robot=robot) for path in sorted(folder.glob("train_*"))]
    found = diagnose(robot, records, jobs=2)
    assert found.verdict.value == answer["verdict"]
    assert {(cause.axis, cause.effect, cause.from_axis) for cause in found.causes} == {
        (effect["axis"], effect["effect"], effect["from_axis"]) for effect in answer["effects"]
    }


def test_a_lateness_is_found_where_the_models_own_parameters_follow_it_half_way(shared_dir):
    """From one record: a slower and better damped axis closes four fifths of a delay's gap."""
    robot = load_robot("rotemina")
    record = read_record(shared_dir / "examples" / "example_20" / "train_1.csv.gz", robot=robot)
    found = examine(Evidence.of(robot, "y", [record]), Account("y"), jobs=2)
    assert found.best.ids == (("delay", None),)
