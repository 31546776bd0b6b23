"""What is said of an axis: what is sure, whatever is left beside it."""

import pytest

from rotemina.sim.gap.compare.decision import Closing, decide, stands
from rotemina.sim.gap.diagnosis import AxisDiagnosis, Diagnosis, Verdict
from rotemina.sim.robot.file import load_robot

FAR = 1e9  # what a black box leaves that knows nothing


@pytest.mark.parametrize(
    ("raw", "left", "black_box", "verdict"),
    [
        (1000.0, 20.0, FAR, Verdict.EXPLAINED),
        (1000.0, 200.0, FAR, Verdict.PARTLY),
        (1000.0, 200.0, 210.0, Verdict.EXPLAINED),
        (1000.0, 900.0, 800.0, Verdict.UNKNOWN),
        (3.0, 1.25, FAR, Verdict.EXPLAINED),
    ],
)
def test_a_verdict_follows_from_what_is_left(raw, left, black_box, verdict):
    assert decide(Closing(raw, left, black_box), [()], doubtful=False) is verdict


def test_a_set_that_tells_nothing_and_a_poor_motion_are_insufficient():
    closing = Closing(1000.0, 20.0, FAR)
    four = ("creep", "delay", "friction", "backlash")
    assert decide(closing, [four], doubtful=False) is Verdict.INSUFFICIENT
    assert decide(closing, [()], doubtful=True) is Verdict.INSUFFICIENT


@pytest.mark.parametrize(
    ("closes", "left", "weight", "standing"),
    [
        (100.0, 20.0, 0.6, True),  # over twice the rms of what is left
        (100.0, 20.0, 0.4, False),  # as likely nothing, or something else
        (100.0, 60.0, 0.96, True),
        (100.0, 60.0, 0.9, False),  # not beyond doubt beside what nothing explains
        (100.0, 110.0, 1.0, False),  # smaller than what nothing explains
        (0.5, 0.0, 0.6, True),  # nothing is left
    ],
)
def test_one_of_several_causes_is_named_by_its_size_beside_the_remainder_and_its_weight(
    closes, left, weight, standing
):
    assert stands(closes, left, weight) is standing


@pytest.mark.parametrize(
    ("verdicts", "robot"),
    [
        (("none", "explained"), "explained"),
        (("partly", "explained"), "partly"),
        (("insufficient_excitation", "partly"), "insufficient_excitation"),
        (("unknown", "insufficient_excitation"), "unknown"),
    ],
)
def test_the_robot_has_the_verdict_of_the_axis_of_which_most_is_open(verdicts, robot):
    axes = {
        name: AxisDiagnosis(name, Verdict(one), ())
        for name, one in zip(("x", "y"), verdicts, strict=True)
    }
    assert Diagnosis(load_robot("rotemina"), axes).verdict.value == robot
