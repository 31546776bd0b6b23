"""Ranking of candidates during the search."""

import pytest

from rotemina.sim.gap.result import Grade
from rotemina.sim.gap.result.ranking import Standings
from rotemina.sim.robot import AxisEffect


def test_the_furthest_trial_counts_and_another_gap_restarts_the_ranking():
    creep = AxisEffect(axis="zn", id="creep")
    standings = Standings("zn")
    standings.begin(101.0)
    standings.add([creep], 11.0, Grade.LOOK)
    # The fit is worse than the screening suggested.
    standings.add([creep], 31.0, Grade.FIT)
    standings.add([creep], 21.0, Grade.LOOK)
    (standing,) = standings.ranking().standings
    assert (standing.left, standing.grade, standing.closed) == (31.0, Grade.FIT, pytest.approx(0.7))
    standings.begin(50.0)
    assert standings.ranking().standings == ()
    assert standings.ranking().tried == 1
