"""Tables of a plant: arrays in the form in which compiled code steps it."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.effects import (
    AttachedEffect,
    EffectStage,
    ForceFunction,
    InputFunction,
    PositionFunction,
    ReadingFunction,
    compile_step_address,
)
from rotemina.sim.errors import BrokenEffectError, EffectError
from rotemina.sim.plant.coupled_groups import AxisGroup, OutputEquation, compute_position_gain
from rotemina.sim.robot import Robot

# A structured array with named columns.
TableArray = NDArray[Any]

#: Phases of the signal chain in which step functions are called, in its order.
PHASES = ("electronics", "actuator", "force", "motion", "reading", "digits")


AXIS_DTYPE = np.dtype(
    [
        # Index of the state that is the position; -1 for a static axis.
        ("place", np.int64),
        # Index of the state that is the speed.
        ("rate", np.int64),
        # Position that a unit of input requests.
        ("asked", np.float64),
        # Where the step functions of each phase begin.
        *((phase, np.int64) for phase in (*PHASES, "end")),
        # Whether the input, position and reading must be computed between samples.
        ("inner_input", np.int64),
        ("inner_position", np.int64),
        ("inner_reading", np.int64),
        # How the controller obtains its speed; 0 without a controller.
        ("loop", np.int64),
        ("kp", np.float64),
        ("kv", np.float64),
        ("limit", np.float64),
        # Index of the axis' delay among the distinct delays.
        ("late", np.int64),
        # Which part of the chain acts on the input.
        ("part", np.int64),
        ("offset", np.float64),
        ("noise_rms", np.float64),
        ("resolution", np.float64),
    ]
)
"""One row for each axis of a plant."""

FUNCTION_DTYPE = np.dtype(
    [
        ("address", np.int64),
        # Where its numbers and its memory begin.
        ("numbers_at", np.int64),
        ("memory_at", np.int64),
        # Row of the output of another axis that it receives; -1 for none.
        ("other", np.int64),
        # Column of its variate, -1 for none; a function with a variate is called only at samples.
        ("variate", np.int64),
    ]
)
"""One row for each step function, sorted by axis and phase."""

OUTPUT_DTYPE = np.dtype(
    [
        # Range of its weights on states.
        ("begin", np.int64),
        ("end", np.int64),
        # Its weight on the input of the axis ``source``.
        ("through", np.float64),
        ("source", np.int64),
    ]
)
"""One row for each output before any effect on it: positions of the axes, then ports."""

GROUP_DTYPE = np.dtype(
    [("first", np.int64), ("states", np.int64), ("member", np.int64), ("axes", np.int64)]
)
"""One row for each group: its first state, its number of states, its first member, its size."""


class PlantTables(NamedTuple):
    """Tables of a plant, and the ``numbers`` of its step functions.

    ``state`` and ``weight`` are the terms of the outputs, ``member`` the axes of the groups.
    """

    axis: TableArray
    function: TableArray
    numbers: FloatArray
    output: TableArray
    state: IntArray
    weight: FloatArray
    group: TableArray
    member: IntArray


class PlacedEffect(NamedTuple):
    """Attached effect with the row of the output that it receives as ``other``; -1 for none."""

    attached: AttachedEffect
    other: int


def make_tables(
    robot: Robot, groups: Sequence[AxisGroup], placed: Sequence[PlacedEffect]
) -> tuple[PlantTables, list[AttachedEffect]]:
    """Assign rows to axes, states and outputs, and sort the step functions.

    Returns
    -------
    tables : PlantTables
        Without controllers and delays.
    order : list of AttachedEffect
        The effects of the step functions, in their order.
    """
    ranked_effects = _rank_effects(tuple(robot.axes), placed)
    axis = _make_axis_table(robot, ranked_effects)
    group, member = _make_group_table(robot, groups, axis)
    output, state, weight = _make_output_table(robot, groups, group)
    order = [effect.attached for *_, effect in ranked_effects]
    numbers = [_compute_numbers(attached) for attached in order]
    function = np.zeros(len(ranked_effects), dtype=FUNCTION_DTYPE)
    function["address"] = [_find_address(attached) for attached in order]
    function["numbers_at"] = np.cumsum([0, *map(len, numbers)])[:-1]
    function["memory_at"] = np.cumsum([0] + [count_states(attached) for attached in order])[:-1]
    function["other"] = [effect.other for *_, effect in ranked_effects]
    is_random = np.array([_is_random(attached) for attached in order], dtype=np.bool_)
    function["variate"] = np.where(is_random, np.cumsum(is_random) - 1, -1)
    tables = PlantTables(
        axis,
        function,
        np.concatenate([*numbers, np.zeros(1)]),
        output,
        state,
        weight,
        group,
        member,
    )
    return tables, order


def _make_axis_table(robot: Robot, ranked_effects: Sequence["_RankedEffect"]) -> TableArray:
    axis = np.zeros(len(robot.axes), dtype=AXIS_DTYPE)
    axis["place"] = axis["rate"] = -1
    axis["asked"] = [compute_position_gain(model) for model in robot.axes.values()]
    axis["offset"] = [model.offset for model in robot.axes.values()]
    sensors = [model.sensor for model in robot.axes.values()]
    axis["noise_rms"] = [sensor.noise_rms if sensor else 0.0 for sensor in sensors]
    axis["resolution"] = [sensor.resolution if sensor else 0.0 for sensor in sensors]
    for axis_row in range(len(axis)):
        for rank, phase in enumerate((*PHASES, "end")):
            axis[phase][axis_row] = sum(effect[:2] < (axis_row, rank) for effect in ranked_effects)
    _mark_inner_calls(axis, ranked_effects)
    return axis


def _mark_inner_calls(axis: TableArray, ranked_effects: Sequence["_RankedEffect"]) -> None:
    """Mark which signals of each axis must be computed between samples.

    The input is marked if the output of a step function changes while its input is held. Position
    and reading are marked if a step function on them needs inner steps because it has memory.
    """
    for axis_row, phase, effect in ranked_effects:
        attached = effect.attached
        if isinstance(attached.formulation.acts, InputFunction):
            axis["inner_input"][axis_row] |= attached.formulation.acts.timed
        elif PHASES[phase] != "force" and np.isfinite(
            attached.formulation.inner_step_s(attached.values, attached.facts)
        ):
            axis["inner_position"][axis_row] = 1
            axis["inner_reading"][axis_row] |= PHASES[phase] == "reading"


def _make_group_table(
    robot: Robot, groups: Sequence[AxisGroup], axis: TableArray
) -> tuple[TableArray, IntArray]:
    """Return the table of groups and their members; enter the states of the axes."""
    names = tuple(robot.axes)
    table = np.zeros(len(groups), dtype=GROUP_DTYPE)
    table["states"] = [group.states for group in groups]
    table["axes"] = [group.size for group in groups]
    table["first"] = np.cumsum(table["states"]) - table["states"]
    table["member"] = np.cumsum(table["axes"]) - table["axes"]
    members: list[int] = []
    for group, first in zip(groups, table["first"], strict=True):
        axis_rows = [names.index(name) for name in group.axes]
        members += axis_rows
        if not group.static:
            axis["place"][axis_rows] = first + np.arange(group.size)
            axis["rate"][axis_rows] = first + group.size + np.arange(group.size)
    return table, np.array(members, dtype=np.int64)


def _make_output_table(
    robot: Robot, groups: Sequence[AxisGroup], group_table: TableArray
) -> tuple[TableArray, IntArray, FloatArray]:
    names = tuple(robot.axes)
    outputs: dict[int, tuple[OutputEquation, int]] = {}
    for group, first in zip(groups, group_table["first"], strict=True):
        for output in group.outputs:
            output_row = (
                names.index(output.axis) if output.port is None else len(names) + output.port
            )
            outputs[output_row] = output, int(first)
    table = np.zeros(len(outputs), dtype=OUTPUT_DTYPE)
    states, weights = [np.zeros(0, dtype=np.int64)], [np.zeros(0)]
    for output_row in range(len(outputs)):
        output, first = outputs[output_row]
        terms = np.flatnonzero(output.weights)
        begin = sum(len(part) for part in states)
        table[output_row] = (begin, begin + len(terms), output.through, names.index(output.axis))
        states.append(first + terms)
        weights.append(output.weights[terms])
    return table, np.concatenate(states), np.concatenate(weights)


def find_phase(attached: AttachedEffect) -> str | None:
    """Return the phase in which an effect's step function is called, or None if it has none."""
    acts = attached.formulation.acts
    if isinstance(acts, InputFunction):
        return "electronics" if attached.effect.stage is EffectStage.ELECTRONICS else "actuator"
    if isinstance(acts, ReadingFunction):
        return "digits" if acts.digital else "reading"
    for kind, phase in ((ForceFunction, "force"), (PositionFunction, "motion")):
        if isinstance(acts, kind):
            return phase
    return None


def _rank_effects(axes: Sequence[str], placed: Sequence[PlacedEffect]) -> list["_RankedEffect"]:
    """Sort the effects that have a step function by axis and phase; the order is stable."""
    ranked_effects = [
        _RankedEffect(axes.index(effect.attached.entry.axis), PHASES.index(phase), effect)
        for effect in placed
        if (phase := find_phase(effect.attached)) is not None
    ]
    return sorted(ranked_effects, key=lambda entry: entry[:2])


class _RankedEffect(NamedTuple):
    axis: int
    phase: int
    placed: PlacedEffect


def _compute_numbers(attached: AttachedEffect) -> FloatArray:
    try:
        numbers = attached.formulation.compute_numbers(attached.values, attached.facts)
    except EffectError:
        raise
    # A plugin may raise anything.
    except Exception as error:
        raise _make_error(
            attached, "the numbers of its step function cannot be made", error
        ) from error
    return numbers


def _find_address(attached: AttachedEffect) -> int:
    acts = attached.formulation.acts
    assert isinstance(acts, InputFunction | ForceFunction | PositionFunction | ReadingFunction)
    try:
        return compile_step_address(acts.step)
    # The compiler, too, may raise anything if the code is not a valid step function.
    except Exception as error:
        raise _make_error(attached, "its step function cannot be compiled", error) from error


def _make_error(attached: AttachedEffect, problem: str, error: Exception) -> BrokenEffectError:
    reason = next((line for line in str(error).splitlines() if line.strip()), "")
    return BrokenEffectError(
        "axis.{axis}.effect {id}: formulation {name}: {what}: {type_name}: {reason}",
        axis=attached.entry.axis,
        id=attached.entry.id,
        name=repr(attached.formulation.name),
        what=problem,
        type_name=type(error).__name__,
        reason=reason,
    )


def count_states(attached: AttachedEffect) -> int:
    """Return the length of the memory of an effect's step function."""
    acts = attached.formulation.acts
    return (
        acts.states
        if isinstance(acts, InputFunction | ForceFunction | PositionFunction | ReadingFunction)
        else 0
    )


def _is_random(attached: AttachedEffect) -> bool:
    acts = attached.formulation.acts
    return isinstance(acts, ReadingFunction) and acts.random
