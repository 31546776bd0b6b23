"""The order of effects, and what may be put where."""

import pytest

from rotemina.plugins.effects.chosen_effects import Chain, candidates, with_formulation, with_value
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
LATE_Z = AxisEffect(axis="z", id="delay")
MODE_Z = AxisEffect(axis="z", id="flexible_mode")
RUB_Z = AxisEffect(axis="z", id="friction")
LOOP = AxisEffect(axis="thx", id="hysteresis")


def test_effects_stand_by_axis_and_stage_and_then_as_they_came():
    chain = Chain.of(ROBOT, (LOOP, RUB_Z, MODE_Z, LATE_Z))
    assert chain.asked == (LATE_Z, RUB_Z, MODE_Z, LOOP)


def test_an_added_effect_is_the_last_of_its_stage():
    chain, place = Chain.of(ROBOT, (LOOP, MODE_Z)).added(RUB_Z)
    assert (chain.asked, place) == ((MODE_Z, RUB_Z, LOOP), 1)
    chain, place = chain.added(LATE_Z)
    assert place == 0


def test_the_same_effect_may_be_added_twice():
    chain, place = Chain.of(ROBOT, (LOOP,)).added(LOOP)
    assert (chain.asked, place) == ((LOOP, LOOP), 1)


def test_only_neighbours_of_one_stage_change_places():
    chain = Chain.of(ROBOT, (LATE_Z, RUB_Z, MODE_Z, LOOP))
    assert [chain.neighbour(place, +1) for place in range(4)] == [None, 2, None, None]
    assert [chain.neighbour(place, -1) for place in range(4)] == [None, None, 1, None]
    assert chain.swapped(1, 2).asked == (LATE_Z, MODE_Z, RUB_Z, LOOP)


def test_removed_and_silent():
    chain = Chain.of(ROBOT, (LATE_Z, LOOP))
    assert chain.removed(0).asked == (LOOP,)
    assert [one.enabled for one in chain.silent] == [False, False]
    assert [one.enabled for one in chain.asked] == [True, True]


def test_a_change_is_checked():
    chain = Chain.of(ROBOT, (LOOP,))
    wide = with_value(chain.effects[0], "width", 2e-4)
    assert chain.changed(0, wide).effects[0].values["width"] == 2e-4
    with pytest.raises(EffectError, match="width = 1"):
        chain.changed(0, with_value(chain.effects[0], "width", 1.0))


def test_another_formulation_keeps_what_it_knows_within_its_bounds():
    mode = AxisEffect(axis="z", id="flexible_mode", parameters={"frequency": 80.0, "share": -1.0})
    (one,) = Chain.of(ROBOT, (mode,)).effects
    other = with_formulation(one, "appendage")
    assert (other.formulation, dict(other.parameters)) == ("appendage", {"frequency": 80.0})


def test_each_axis_is_offered_what_may_sit_on_it():
    effects, _ = all_effects()
    piezo, stepper = candidates(ROBOT, "thx", effects), candidates(ROBOT, "x", effects)
    assert "hysteresis" in piezo
    assert "hysteresis" not in stepper
    assert "friction" in stepper
    assert "friction" not in piezo
    modes = effects["flexible_mode"].formulations
    assert stepper["flexible_mode"] == [formulation.name for formulation in modes]
    assert list(piezo) == [effect_id for effect_id in effects if effect_id in piezo]


def test_a_single_axis_is_offered_no_coupling_and_a_static_one_no_dynamics():
    effects, _ = all_effects()
    alone = load_robot("picma")
    offered = candidates(alone, "p", effects)
    assert "hysteresis" in offered
    assert "cross_coupling" not in offered
    assert "resonance_mismatch" not in offered
