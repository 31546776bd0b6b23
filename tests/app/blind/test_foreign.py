"""A case in which a check for even rows once named additional causes."""

import pytest

from rotemina.sim.blind import draw_case, write_case
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.records import read_record
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


@pytest.mark.slow
def test_evenly_spaced_rows_do_not_add_causes(tmp_path):
    case = draw_case(ROBOT, "double", 602)
    write_case(tmp_path, case, ROBOT)
    records = [read_record(path, robot=ROBOT) for path in sorted(tmp_path.glob("train_*"))]
    named_causes = {(cause.axis, cause.effect) for cause in diagnose(ROBOT, records).causes}
    assert named_causes == {
        (effect["axis"], effect["effect"]) for effect in case.label()["effects"]
    }
