"""Verdict on an axis: sure causes are named, however large the remainder is."""

import pytest

from rotemina.sim.gap.compare import Closing, decide
from rotemina.sim.gap.compare.verdict import stands
from rotemina.sim.gap.result import (
    GapVerdict,
)

# The remainder of a black box that has learned nothing.
USELESS_BLACK_BOX = 1e9


@pytest.mark.parametrize(
    ("closing", "options", "verdict"),
    [
        (Closing(1000.0, 20.0, USELESS_BLACK_BOX), {}, GapVerdict.EXPLAINED),
        (Closing(1000.0, 200.0, USELESS_BLACK_BOX), {}, GapVerdict.PARTLY),
        (Closing(1000.0, 200.0, 210.0), {}, GapVerdict.EXPLAINED),
        (Closing(1000.0, 900.0, 800.0), {}, GapVerdict.UNKNOWN),
        (Closing(3.0, 1.25, USELESS_BLACK_BOX), {}, GapVerdict.EXPLAINED),
        (
            Closing(1000.0, 20.0, USELESS_BLACK_BOX),
            {"ambiguous": [("creep", "delay", "friction", "backlash")]},
            GapVerdict.INSUFFICIENT,
        ),
        (Closing(1000.0, 20.0, USELESS_BLACK_BOX), {"poor": True}, GapVerdict.INSUFFICIENT),
        # Half of the gap, without an alternative.
        (Closing(1000.0, 500.0, USELESS_BLACK_BOX), {"sure": True}, GapVerdict.PARTLY),
        (Closing(1000.0, 500.0, USELESS_BLACK_BOX), {}, GapVerdict.UNKNOWN),
        (Closing(1000.0, 800.0, USELESS_BLACK_BOX), {"sure": True}, GapVerdict.UNKNOWN),
        # A gap of the sensor, next to a larger one at a finer reference.
        (Closing(1000.0, 950.0, USELESS_BLACK_BOX, 0.9), {}, GapVerdict.PARTLY),
    ],
)
def test_a_verdict_follows_from_the_remainder(closing, options, verdict):
    options = {"ambiguous": [()], "poor": False, "sure": False} | options
    assert decide(closing, **options) is verdict


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
