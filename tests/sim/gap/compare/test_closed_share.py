"""The closed share of a gap."""

import pytest

from rotemina.sim.gap.result import closed


@pytest.mark.parametrize(
    ("before", "after", "share"),
    [
        (101.0, 101.0, 0.0),
        (101.0, 1.0, 1.0),
        (101.0, 26.0, 0.75),
        (101.0, 0.5, 1.0),  # Below the floor there is nothing more to close.
        (101.0, 500.0, 0.0),  # A worse model closes nothing.
        (0.9, 0.9, 1.0),
    ],
)
def test_the_share_is_of_the_power_beyond_the_floor(before, after, share):
    assert closed(before, after) == pytest.approx(share)
