"""Change of the effects during a run."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.effects import AddedStates, AttachedEffect
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.plant_arrays import count_states
from rotemina.sim.plant.state import PlantState

# Axis, effect, formulation and source axis, and the number among effects that are equal in these.
_EffectKey = tuple[str, str, str, str | None, int]


class _FunctionMemory(NamedTuple):
    number: int
    begin: int
    length: int


def transfer_state(plant: Plant, previous_plant: Plant, state: PlantState) -> PlantState:
    """Return ``state`` of ``previous_plant`` as a state of ``plant``, which has the same axes.

    The axes continue from their positions and speeds. An effect that existed before keeps its
    memory, or the motion of its linear states, even if its parameters change. A new effect starts
    as if the current input had been reached by a rise long ago.
    """
    old_axes, new_axes = previous_plant.assembly.tables.axis, plant.assembly.tables.axis
    has_dynamics = new_axes["place"] >= 0
    position, velocity = state.position[-1].copy(), np.zeros(len(plant.axes))
    position[has_dynamics] = state.x[old_axes["place"][has_dynamics]]
    velocity[has_dynamics] = state.x[old_axes["rate"][has_dynamics]]
    rest_state = plant.make_state(float(state.time_s[-1]), state.inputs[-1], position, velocity)
    memory, called_s = rest_state.memory, np.full(len(rest_state.called_s), state.elapsed_s)
    old_functions = dict(_list_functions(previous_plant))
    for key, new_function in _list_functions(plant):
        if key in old_functions and old_functions[key].length == new_function.length:
            old_function = old_functions[key]
            memory[new_function.begin : new_function.begin + new_function.length] = state.memory[
                old_function.begin : old_function.begin + old_function.length
            ]
            called_s[new_function.number] = state.called_s[old_function.number]
    old_parts = dict(_list_parts(previous_plant))
    for key, states in _list_parts(plant):
        if key in old_parts and len(state.x[old_parts[key]]) == len(rest_state.x[states]):
            rest_state.x[states] = state.x[old_parts[key]]
    return replace(state, x=rest_state.x, memory=memory, called_s=called_s)


def _list_functions(plant: Plant) -> Iterator[tuple[_EffectKey, _FunctionMemory]]:
    counts: Counter[tuple[str, str, str, str | None]] = Counter()
    begins = plant.assembly.tables.function["memory_at"]
    for number, effect in enumerate(plant.assembly.functions):
        identity = _identify_effect(effect)
        yield (
            (*identity, counts[identity]),
            _FunctionMemory(number, int(begins[number]), count_states(effect)),
        )
        counts[identity] += 1


def _list_parts(plant: Plant) -> Iterator[tuple[_EffectKey, slice]]:
    counts: Counter[tuple[str, str, str, str | None]] = Counter()
    groups = plant.assembly.all_groups
    for group, first in zip(groups, plant.assembly.tables.group["first"], strict=True):
        begin = int(first) + (0 if group.static else 2 * group.size)
        for effect in plant.effects:
            acts = effect.formulation.acts
            if (
                isinstance(acts, AddedStates)
                and (effect.entry.from_axis or effect.entry.axis) in group.axes
            ):
                identity, end = (
                    _identify_effect(effect),
                    begin + len(acts.part(effect.values, effect.facts).a),
                )
                yield (*identity, counts[identity]), slice(begin, end)
                counts[identity] += 1
                begin = end


def _identify_effect(effect: AttachedEffect) -> tuple[str, str, str, str | None]:
    return effect.entry.axis, effect.entry.id, effect.formulation.name, effect.entry.from_axis
