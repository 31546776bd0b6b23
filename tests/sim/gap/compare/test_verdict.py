"""Verdict on an axis: sure causes are named, however large the remainder is."""

import pytest

from rotemina.sim.gap.compare import Closing, decide
from rotemina.sim.gap.compare.verdict import stands
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    Diagnosis,
    GapVerdict,
)
from rotemina.sim.robot_files import load_robot

# The remainder of a black box that has learned nothing.
USELESS_BLACK_BOX = 1e9


@pytest.mark.parametrize(
    ("raw", "remainder", "black_box", "verdict"),
    [
        (1000.0, 20.0, USELESS_BLACK_BOX, GapVerdict.EXPLAINED),
        (1000.0, 200.0, USELESS_BLACK_BOX, GapVerdict.PARTLY),
        (1000.0, 200.0, 210.0, GapVerdict.EXPLAINED),
        (1000.0, 900.0, 800.0, GapVerdict.UNKNOWN),
        (3.0, 1.25, USELESS_BLACK_BOX, GapVerdict.EXPLAINED),
    ],
)
def test_a_verdict_follows_from_the_remainder(raw, remainder, black_box, verdict):
    assert decide(Closing(raw, remainder, black_box), [()], poor=False, sure=False) is verdict


def test_too_many_alternatives_and_a_poor_motion_are_insufficient():
    closing = Closing(1000.0, 20.0, USELESS_BLACK_BOX)
    alternatives = ("creep", "delay", "friction", "backlash")
    assert decide(closing, [alternatives], poor=False, sure=False) is GapVerdict.INSUFFICIENT
    assert decide(closing, [()], poor=True, sure=False) is GapVerdict.INSUFFICIENT


@pytest.mark.parametrize(
    ("remainder", "at_a_tap", "sure", "verdict"),
    [
        (500.0, 0.0, True, GapVerdict.PARTLY),  # Half of the gap, without an alternative.
        (500.0, 0.0, False, GapVerdict.UNKNOWN),
        (800.0, 0.0, True, GapVerdict.UNKNOWN),
        # A gap of the sensor, next to a larger one at a finer reference.
        (950.0, 0.9, False, GapVerdict.PARTLY),
    ],
)
def test_a_sure_cause_is_named_whatever_the_remainder(remainder, at_a_tap, sure, verdict):
    closing = Closing(1000.0, remainder, USELESS_BLACK_BOX, at_a_tap)
    assert decide(closing, [()], poor=False, sure=sure) is verdict


@pytest.mark.parametrize(
    ("closed_power", "remainder", "weight", "is_named"),
    [
        (100.0, 30.0, 0.6, True),  # It removes over 70 % of the rest.
        (100.0, 30.0, 0.4, False),  # As likely nothing, or another cause.
        (100.0, 45.0, 1.0, False),  # Too little next to the unexplained remainder.
        (0.5, 0.0, 0.6, True),  # Nothing remains.
    ],
)
def test_one_of_several_causes_is_named_by_its_size_relative_to_the_remainder_and_its_weight(
    closed_power, remainder, weight, is_named
):
    assert stands(closed_power, remainder, weight) is is_named


@pytest.mark.parametrize(
    ("verdicts", "robot_verdict"),
    [
        (("none", "explained"), "explained"),
        (("partly", "explained"), "partly"),
        (("insufficient_excitation", "partly"), "insufficient_excitation"),
        (("unknown", "insufficient_excitation"), "unknown"),
    ],
)
def test_the_robot_has_the_verdict_of_its_least_certain_axis(verdicts, robot_verdict):
    axes = {
        name: AxisDiagnosis(name, GapVerdict(verdict), ())
        for name, verdict in zip(("x", "y"), verdicts, strict=True)
    }
    assert Diagnosis(load_robot("rotemina"), axes).verdict.value == robot_verdict
