"""The order of the chosen effects, and which effects each axis is offered."""

import pytest

from rotemina.plugins.effects.chosen_effects import (
    ChosenEffects,
    find_candidates,
    with_formulation,
    with_value,
)
from rotemina.sim.effects import load_all_effects
from rotemina.sim.errors import EffectError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
DELAY_Z = AxisEffect(axis="z", id="delay")
FLEXIBLE_MODE_Z = AxisEffect(axis="z", id="flexible_mode")
FRICTION_Z = AxisEffect(axis="z", id="friction")
HYSTERESIS_THX = AxisEffect(axis="thx", id="hysteresis")


def test_effects_are_sorted_by_axis_and_stage_and_keep_their_order():
    chain = ChosenEffects.from_effects(
        ROBOT, (HYSTERESIS_THX, FRICTION_Z, FLEXIBLE_MODE_Z, DELAY_Z)
    )
    assert chain.requests == (DELAY_Z, FRICTION_Z, FLEXIBLE_MODE_Z, HYSTERESIS_THX)


def test_an_added_effect_comes_last_in_its_stage_and_may_be_added_twice():
    chain, index = ChosenEffects.from_effects(ROBOT, (HYSTERESIS_THX, FLEXIBLE_MODE_Z)).with_effect(
        FRICTION_Z
    )
    assert (chain.requests, index) == ((FLEXIBLE_MODE_Z, FRICTION_Z, HYSTERESIS_THX), 1)
    chain, index = chain.with_effect(HYSTERESIS_THX)
    assert (chain.requests[2:], index) == ((HYSTERESIS_THX, HYSTERESIS_THX), 3)
    chain, index = chain.with_effect(DELAY_Z)
    assert index == 0


def test_only_neighbours_within_a_stage_can_be_swapped():
    chain = ChosenEffects.from_effects(
        ROBOT, (DELAY_Z, FRICTION_Z, FLEXIBLE_MODE_Z, HYSTERESIS_THX)
    )
    assert [chain.find_neighbour(index, +1) for index in range(4)] == [None, 2, None, None]
    assert [chain.find_neighbour(index, -1) for index in range(4)] == [None, None, 1, None]
    assert chain.with_swap(1, 2).requests == (DELAY_Z, FLEXIBLE_MODE_Z, FRICTION_Z, HYSTERESIS_THX)


def test_effects_are_removed_and_disabled():
    chain = ChosenEffects.from_effects(ROBOT, (DELAY_Z, HYSTERESIS_THX))
    assert chain.without_effect(0).requests == (HYSTERESIS_THX,)
    assert [request.enabled for request in chain.disabled_requests] == [False, False]
    assert [request.enabled for request in chain.requests] == [True, True]


def test_a_changed_value_is_validated():
    chain = ChosenEffects.from_effects(ROBOT, (HYSTERESIS_THX,))
    wide = with_value(chain.effects[0], "width", 2e-4)
    assert chain.with_replacement(0, wide).effects[0].values["width"] == 2e-4
    with pytest.raises(EffectError, match="width = 1"):
        chain.with_replacement(0, with_value(chain.effects[0], "width", 1.0))


def test_another_formulation_keeps_only_valid_values_of_shared_parameters():
    mode = AxisEffect(axis="z", id="flexible_mode", parameters={"frequency": 80.0, "share": -1.0})
    (effect,) = ChosenEffects.from_effects(ROBOT, (mode,)).effects
    other = with_formulation(effect, "appendage")
    assert (other.formulation, dict(other.parameters)) == ("appendage", {"frequency": 80.0})


@pytest.mark.parametrize(
    ("robot", "axis", "offered", "withheld"),
    [
        ("rotemina", "thx", {"hysteresis", "cross_coupling"}, {"friction"}),
        ("rotemina", "x", {"friction", "resonance_mismatch"}, {"hysteresis"}),
        # A single static axis has neither coupling nor dynamics.
        ("picma", "p", {"hysteresis"}, {"cross_coupling", "resonance_mismatch"}),
    ],
)
def test_each_axis_is_offered_the_effects_that_fit_its_type(robot, axis, offered, withheld):
    effects, _ = load_all_effects()
    candidates = find_candidates(load_robot(robot), axis, effects)
    assert offered <= set(candidates)
    assert not withheld & set(candidates)
    assert list(candidates) == [effect_id for effect_id in effects if effect_id in candidates]
    if "flexible_mode" in candidates:
        modes = effects["flexible_mode"].formulations
        assert candidates["flexible_mode"] == [formulation.name for formulation in modes]
