"""A run that continues with other effects than it began with."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Part
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.plant_arrays import states_of
from rotemina.sim.plant.state import PlantState

_Key = tuple[str, str, str, str | None, int]


def taken_over(plant: Plant, before: Plant, state: PlantState) -> PlantState:
    """Return ``state`` of ``before`` as a state of ``plant``, with the same axes.

    Axes go on from their positions and speeds. An effect that was there keeps its memory, or the
    motion of its linear states, also when its parameters change; a new one begins as after a rise
    to the present input, long ago.
    """
    old, new = before.assembly.machine.axis, plant.assembly.machine.axis
    moving = new["place"] >= 0
    position, velocity = state.position[-1].copy(), np.zeros(len(plant.axes))
    position[moving] = state.x[old["place"][moving]]
    velocity[moving] = state.x[old["rate"][moving]]
    fresh = plant.at(float(state.time_s[-1]), state.inputs[-1], position, velocity)
    memory, seen = fresh.memory, np.full(len(fresh.seen), state.elapsed_s)
    kept = dict(_functions(before))
    for key, (number, begin, length) in _functions(plant):
        if key in kept and kept[key][2] == length:
            old_number, old_begin, _ = kept[key]
            memory[begin : begin + length] = state.memory[old_begin : old_begin + length]
            seen[number] = state.seen[old_number]
    moved = dict(_parts(before))
    for key, own in _parts(plant):
        if key in moved and len(state.x[moved[key]]) == len(fresh.x[own]):
            fresh.x[own] = state.x[moved[key]]
    return replace(state, x=fresh.x, memory=memory, seen=seen)


def _functions(plant: Plant) -> Iterator[tuple[_Key, tuple[int, int, int]]]:
    """Yield each step function by what it is, with its number and where its memory lies."""
    count: Counter[tuple[str, str, str, str | None]] = Counter()
    begins = plant.assembly.machine.function["memory_at"]
    for number, one in enumerate(plant.assembly.functions):
        kind = _kind(one)
        yield (*kind, count[kind]), (number, int(begins[number]), states_of(one))
        count[kind] += 1


def _parts(plant: Plant) -> Iterator[tuple[_Key, slice]]:
    """Yield each linear part by what it is, with where its states are among those of the plant."""
    count: Counter[tuple[str, str, str, str | None]] = Counter()
    groups = plant.assembly.all_groups
    for group, first in zip(groups, plant.assembly.machine.group["first"], strict=True):
        begin = int(first) + (0 if group.static else 2 * group.size)
        for one in plant.effects:
            acts = one.formulation.acts
            if isinstance(acts, Part) and (one.asked.from_axis or one.asked.axis) in group.axes:
                kind, end = _kind(one), begin + len(acts.part(one.values, one.facts).a)
                yield (*kind, count[kind]), slice(begin, end)
                count[kind] += 1
                begin = end


def _kind(one: Attached) -> tuple[str, str, str, str | None]:
    return one.asked.axis, one.asked.id, one.formulation.name, one.asked.from_axis
