"""When what a cause closes counts: shares of the gap, of what is left, of what was set aside."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.selection import _enters
from rotemina.sim.records.record import Tap

LAG = SimpleNamespace(id="amplifier_lag")


def left(meas, *causes):
    return SimpleNamespace(by_tap={Tap.MEAS: meas}, causes=causes)


@pytest.mark.parametrize(
    ("before", "after", "counts"),
    [
        (left(2000.0), left(60.0, LAG), True),
        (left(70.0, LAG), left(6.0, LAG, LAG), True),  # 3 % of the gap
        (left(50.0, LAG), left(1.0, LAG, LAG), False),  # how a machine differs from a formula
        (left(50.0), left(30.0, LAG), False),
        (left(15.0), left(1.0, LAG), True),  # what no re-tuning does
        (left(1.5), left(1.0, LAG), False),
    ],
)
def test_beside_others_a_cause_closes_a_share_of_the_gap(before, after, counts):
    assert _enters(left(2000.0), {}, before, after) is counts


def test_what_was_set_aside_may_leave_something_of_itself():
    before, after = left(60.0), left(20.0, LAG)
    assert _enters(left(60.0), {Tap.MEAS: 1000.0}, before, after)
    assert not _enters(left(60.0), {Tap.MEAS: 10_000.0}, before, after)
