"""Verdict and corrected model of a robot with several axes."""

import pytest

from rotemina.sim.gap.result import (
    AxisDiagnosis,
    Diagnosis,
    GapVerdict,
)
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(
    ("verdicts", "robot_verdict"),
    [
        ((), GapVerdict.NONE),
        ((GapVerdict.NONE, GapVerdict.EXPLAINED), GapVerdict.EXPLAINED),
        ((GapVerdict.PARTLY, GapVerdict.EXPLAINED), GapVerdict.PARTLY),
        ((GapVerdict.INSUFFICIENT, GapVerdict.PARTLY), GapVerdict.INSUFFICIENT),
        ((GapVerdict.UNKNOWN, GapVerdict.NONE, GapVerdict.INSUFFICIENT), GapVerdict.UNKNOWN),
    ],
)
def test_the_robot_has_the_verdict_of_its_least_certain_axis(verdicts, robot_verdict):
    axes = {
        name: AxisDiagnosis(name, verdict, ())
        for name, verdict in zip("xyz", verdicts, strict=False)
    }
    assert Diagnosis(ROBOT, axes).verdict is robot_verdict


def test_the_corrected_model_has_the_fitted_effects_of_all_axes():
    thx_creep, thy_creep = (AxisEffect(axis=axis, id="creep") for axis in ("thx", "thy"))
    axes = {
        "thx": AxisDiagnosis("thx", GapVerdict.EXPLAINED, (), fitted=(thx_creep,)),
        "thy": AxisDiagnosis("thy", GapVerdict.PARTLY, (), fitted=(thy_creep,)),
    }
    assert list(Diagnosis(ROBOT, axes).fitted) == [thx_creep, thy_creep]
