"""How candidates rank while they are tried."""

import pytest

from rotemina.sim.gap.compare.ranking import Grade, Standings
from rotemina.sim.robot.model import AxisEffect


def test_what_was_tried_further_counts_and_another_gap_begins_anew():
    creep = AxisEffect(axis="zn", id="creep")
    standings = Standings("zn")
    standings.begin(101.0)
    standings.add([creep], 11.0, Grade.LOOK)
    standings.add([creep], 31.0, Grade.FIT)  # it holds less than it promised
    standings.add([creep], 21.0, Grade.LOOK)
    (one,) = standings.ranking().standings
    assert (one.left, one.grade, one.closed) == (31.0, Grade.FIT, pytest.approx(0.7))
    standings.begin(50.0)
    assert standings.ranking().standings == ()
    assert standings.ranking().tried == 1
