"""Cases of the second generator in which a look at even rows once accused more than was there."""

import pytest

from rotemina.sim.blind.case import draw_case
from rotemina.sim.blind.files import write_case
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "seed"), [("double", 602), ("single", 504)])
def test_rows_that_count_evenly_accuse_nobody_else(tmp_path, kind, seed):
    case = draw_case(ROBOT, kind, seed)
    write_case(tmp_path, case, ROBOT)
    records = [read_record(path, robot=ROBOT) for path in sorted(tmp_path.glob("train_*"))]
    found = {(one.axis, one.effect) for one in diagnose(ROBOT, records).causes}
    assert found == {(one["axis"], one["effect"]) for one in case.label()["effects"]}
