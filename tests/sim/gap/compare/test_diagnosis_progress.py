"""Progress of the examination of one axis."""

import pytest

from rotemina.sim.gap.compare.diagnosis_progress import Account
from rotemina.sim.gap.compare.ranking import Grade
from rotemina.sim.robot.model import AxisEffect


def test_an_axis_fills_its_own_share_of_the_whole():
    steps = []
    account = Account("zn", steps.append, begin=0.5, share=0.25)
    for stage in ("screening", "fitting", "deciding"):
        account.tell(stage, "creep")
    assert [one.share for one in steps] == pytest.approx([0.5, 0.575, 0.725])
    assert {(one.axis, one.candidate) for one in steps} == {("zn", "creep")}


def test_a_second_look_does_not_turn_progress_back():
    steps = []
    account = Account("zn", steps.append)
    account.tell("deciding", None)
    account.tell("screening", "creep")
    assert steps[1].stage == "screening"
    assert steps[1].share == steps[0].share


def test_the_ranking_stays_with_the_steps_that_follow():
    steps = []
    account = Account("zn", steps.append)
    account.begin(101.0)
    account.tried([AxisEffect(axis="zn", id="creep")], 11.0, Grade.FIT)
    account.tell("deciding", None)
    account.heartbeat()
    assert steps[0].ranking == steps[1].ranking
    assert steps[2] == steps[1]


def test_what_a_listener_raises_ends_the_work():
    class StopError(Exception):
        pass

    def listener(_):
        raise StopError

    with pytest.raises(StopError):
        Account("zn", listener).heartbeat()
