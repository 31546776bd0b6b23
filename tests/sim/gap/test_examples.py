"""The example cases with known answers: the correct effects on the correct axes."""

import json

import pytest

from rotemina.sim.gap.examination import examine
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.gap.result import Account
from rotemina.sim.records import read_record
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow


# Two effects with a coupling, an unknown gap, a screw, a healthy robot, a backlash.
@pytest.mark.parametrize("number", [1, 2, 3, 4, 7])
def test_an_example_is_diagnosed_correctly(shared_dir, number):
    folder = shared_dir / "examples" / f"example_{number}"
    answer = json.loads((folder / "answer.json").read_text(encoding="utf-8"))
    robot = load_robot("rotemina")
    records = [read_record(path, robot=robot) for path in sorted(folder.glob("train_*"))]
    diagnosis = diagnose(robot, records, jobs=2)
    assert diagnosis.verdict.value == answer["verdict"]
    assert {(cause.axis, cause.effect, cause.from_axis) for cause in diagnosis.causes} == {
        (effect["axis"], effect["effect"], effect["from_axis"]) for effect in answer["effects"]
    }


def test_a_delay_is_found_although_model_parameters_partly_imitate_it(shared_dir):
    """In one record, a slower and better damped axis would close four fifths of the gap."""
    robot = load_robot("rotemina")
    record = read_record(shared_dir / "examples" / "example_20" / "train_1.csv.gz", robot=robot)
    examination = examine(Evidence.of(robot, "y", [record]), Account("y"), jobs=2)
    assert examination.best.ids == (("delay", None),)
