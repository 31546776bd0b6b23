"""Progress of the examination of one axis."""

import pytest

from rotemina.sim.gap.result import Account, Grade
from rotemina.sim.robot import AxisEffect


def test_an_axis_fills_its_share_of_the_progress_which_never_falls():
    steps = []
    account = Account("zn", steps.append, begin=0.5, share=0.25)
    for stage in ("screening", "fitting", "deciding", "screening"):
        account.tell(stage, "creep")
    assert [step.share for step in steps] == pytest.approx([0.5, 0.575, 0.725, 0.725])
    assert steps[-1].stage == "screening"
    assert {(step.axis, step.candidate) for step in steps} == {("zn", "creep")}


def test_later_steps_keep_the_ranking():
    steps = []
    account = Account("zn", steps.append)
    account.begin(101.0)
    account.tried([AxisEffect(axis="zn", id="creep")], 11.0, Grade.FIT)
    account.tell("deciding", None)
    account.heartbeat()
    assert steps[0].ranking == steps[1].ranking
    assert steps[2] == steps[1]
