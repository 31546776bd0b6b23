"""What a diagnosis of several axes says of the robot."""

import pytest

from rotemina.sim.gap.diagnosis import AxisDiagnosis, Diagnosis, Verdict
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(
    ("verdicts", "whole"),
    [
        ((), Verdict.NONE),
        ((Verdict.NONE, Verdict.EXPLAINED), Verdict.EXPLAINED),
        ((Verdict.UNKNOWN, Verdict.NONE, Verdict.PARTLY), Verdict.UNKNOWN),
    ],
)
def test_the_least_certain_axis_speaks_for_the_robot(verdicts, whole):
    axes = {name: AxisDiagnosis(name, one, ()) for name, one in zip("xyz", verdicts, strict=False)}
    assert Diagnosis(ROBOT, axes).verdict is whole


def test_the_corrected_model_has_what_was_fitted_on_all_axes():
    one, other = (AxisEffect(axis=axis, id="creep") for axis in ("thx", "thy"))
    axes = {
        "thx": AxisDiagnosis("thx", Verdict.EXPLAINED, (), fitted=(one,)),
        "thy": AxisDiagnosis("thy", Verdict.PARTLY, (), fitted=(other,)),
    }
    assert list(Diagnosis(ROBOT, axes).fitted) == [one, other]
