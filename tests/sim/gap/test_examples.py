"""The example cases with answers: the right effects on the right axes."""

import json

import pytest

from rotemina.sim.gap.diagnosis_pipeline import diagnose
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
