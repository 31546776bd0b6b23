"""Progress of the examination of one axis."""

import pytest

from rotemina.sim.gap.result import Account, Grade
from rotemina.sim.robot import AxisEffect


def test_an_axis_fills_its_share_of_the_progress():
    steps = []
    account = Account("zn", steps.append, begin=0.5, share=0.25)
    for stage in ("screening", "fitting", "deciding"):
        account.tell(stage, "creep")
    assert [step.share for step in steps] == pytest.approx([0.5, 0.575, 0.725])
    assert {(step.axis, step.candidate) for step in steps} == {("zn", "creep")}


def test_a_second_screening_does_not_lower_the_progress():
    steps = []
    account = Account("zn", steps.append)
    account.tell("deciding", None)
    account.tell("screening", "creep")
    assert steps[1].stage == "screening"
    assert steps[1].share == steps[0].share


def test_later_steps_keep_the_ranking():
    steps = []
    account = Account("zn", steps.append)
    account.begin(101.0)
    account.tried([AxisEffect(axis="zn", id="creep")], 11.0, Grade.FIT)
    account.tell("deciding", None)
    account.heartbeat()
    assert steps[0].ranking == steps[1].ranking
    assert steps[2] == steps[1]


def test_an_exception_in_a_listener_ends_the_work():
    class StopError(Exception):
        pass

    def listener(_):
        raise StopError

    with pytest.raises(StopError):
        Account("zn", listener).heartbeat()
