"""What is said of an axis: what is sure, whatever is left beside it."""

import pytest

from rotemina.sim.gap.compare.verdict import Closing, decide, stands
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
    assert decide(Closing(raw, left, black_box), [()], poor=False, sure=False) is verdict


def test_a_set_that_tells_nothing_and_a_poor_motion_are_insufficient():
    closing = Closing(1000.0, 20.0, FAR)
    four = ("creep", "delay", "friction", "backlash")
    assert decide(closing, [four], poor=False, sure=False) is Verdict.INSUFFICIENT
    assert decide(closing, [()], poor=True, sure=False) is Verdict.INSUFFICIENT


@pytest.mark.parametrize(
    ("left", "at_a_tap", "sure", "verdict"),
    [
        (500.0, 0.0, True, Verdict.PARTLY),  # half of the gap, and nothing else could be there
        (500.0, 0.0, False, Verdict.UNKNOWN),
        (800.0, 0.0, True, Verdict.UNKNOWN),
        (950.0, 0.9, False, Verdict.PARTLY),  # the sensor's, beside more at a finer reference
    ],
)
def test_what_is_sure_is_named_whatever_is_left(left, at_a_tap, sure, verdict):
    closing = Closing(1000.0, left, FAR, at_a_tap)
    assert decide(closing, [()], poor=False, sure=sure) is verdict


@pytest.mark.parametrize(
    ("closes", "left", "weight", "standing"),
    [
        (100.0, 30.0, 0.6, True),  # it takes over 70 % of the rest away
        (100.0, 30.0, 0.4, False),  # as likely nothing, or something else
        (100.0, 45.0, 1.0, False),  # too little beside what nothing explains
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
