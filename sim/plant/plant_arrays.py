"""A plant as arrays, the form in which compiled code steps it."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.errors import BrokenEffectError, EffectError
from rotemina.sim.effects.formulation import Drive, Force, Motion, Reading, Stage
from rotemina.sim.effects.step import address_of
from rotemina.sim.messages import message
from rotemina.sim.plant.coupled_groups import Group, Output, asked_position
from rotemina.sim.robot.model import Robot

TableArray = NDArray[Any]  # structured: one row for each thing, its columns are named

#: The places in the signal chain at which step functions are called, in its order.
PHASES = ("electronics", "actuator", "force", "motion", "reading", "digits")


AXIS = np.dtype(
    [
        ("place", np.int64),  # the state that is the position, -1 of a static axis
        ("rate", np.int64),  # the state that is the speed
        ("asked", np.float64),  # the position that a unit of input asks for
        *((phase, np.int64) for phase in (*PHASES, "end")),  # where the functions of each begin
        ("inner_input", np.int64),  # whether the input moves between samples,
        ("inner_position", np.int64),  # and whether position
        ("inner_reading", np.int64),  # and reading are followed there
        ("loop", np.int64),  # how a loop obtains its speed, 0 without
        ("kp", np.float64),
        ("kv", np.float64),
        ("limit", np.float64),
        ("late", np.int64),  # which of the delays is its own
        ("part", np.int64),  # how much of the chain acts
        ("offset", np.float64),
        ("noise_rms", np.float64),
        ("resolution", np.float64),
    ]
)
"""One row for each axis of a plant."""

FUNCTION = np.dtype(
    [
        ("address", np.int64),
        ("numbers_at", np.int64),  # where its own numbers begin
        ("memory_at", np.int64),  # where its own memory begins
        ("other", np.int64),  # the output that it sees of another axis, -1 for none
        ("variate", np.int64),  # the column of its variate, called at samples alone; -1 for none
    ]
)
"""One row for each step function, sorted by axis and phase."""

OUTPUT = np.dtype(
    [
        ("begin", np.int64),  # of its weights on states,
        ("end", np.int64),
        ("through", np.float64),  # and its weight on the input
        ("source", np.int64),  # of this axis
    ]
)
"""One row for each position before any effect on it, those of the axes first, then ports."""

GROUP = np.dtype(
    [("first", np.int64), ("states", np.int64), ("member", np.int64), ("axes", np.int64)]
)
"""One row for each group: its first state, its number of states, its first member, its size."""


class Machine(NamedTuple):
    """The tables of a plant, and the ``numbers`` of its step functions.

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
    """An attached effect with the output that it sees as ``other``, -1 for none."""

    attached: Attached
    other: int


def machine_of(
    robot: Robot, groups: Sequence[Group], placed: Sequence[PlacedEffect]
) -> tuple[Machine, list[Attached]]:
    """Give axes, states and outputs their numbers, and line the step functions up.

    Returns
    -------
    machine : Machine
        Without loops and delays.
    order : list of Attached
        The effects of the step functions, in their order.
    """
    ranked = _ranked(tuple(robot.axes), placed)
    axis = _axis_table(robot, ranked)
    group, member = _group_table(robot, groups, axis)
    output, state, weight = _output_table(robot, groups, group)
    order = [one.attached for *_, one in ranked]
    numbers = [_numbers(one) for one in order]
    function = np.zeros(len(ranked), dtype=FUNCTION)
    function["address"] = [_address(one) for one in order]
    function["numbers_at"] = np.cumsum([0] + [len(own) for own in numbers])[:-1]
    function["memory_at"] = np.cumsum([0] + [states_of(one) for one in order])[:-1]
    function["other"] = [one.other for *_, one in ranked]
    random = np.array([_random(one) for one in order], dtype=np.bool_)
    function["variate"] = np.where(random, np.cumsum(random) - 1, -1)
    machine = Machine(
        axis,
        function,
        np.concatenate([*numbers, np.zeros(1)]),
        output,
        state,
        weight,
        group,
        member,
    )
    return machine, order


def _axis_table(robot: Robot, ranked: Sequence["_Ranked"]) -> TableArray:
    axis = np.zeros(len(robot.axes), dtype=AXIS)
    axis["place"] = axis["rate"] = -1
    axis["asked"] = [asked_position(one) for one in robot.axes.values()]
    axis["offset"] = [one.offset for one in robot.axes.values()]
    sensors = [one.sensor for one in robot.axes.values()]
    axis["noise_rms"] = [sensor.noise_rms if sensor else 0.0 for sensor in sensors]
    axis["resolution"] = [sensor.resolution if sensor else 0.0 for sensor in sensors]
    for number in range(len(axis)):
        for rank, phase in enumerate((*PHASES, "end")):
            axis[phase][number] = sum(one[:2] < (number, rank) for one in ranked)
    _follow_inner(axis, ranked)
    return axis


def _follow_inner(axis: TableArray, ranked: Sequence["_Ranked"]) -> None:
    """Mark what of each axis is followed between samples.

    The input where a function's output moves while its input is held; position and reading where
    a function of theirs asks for fine steps, because it remembers what passed.
    """
    for number, phase, one in ranked:
        attached = one.attached
        if isinstance(attached.formulation.acts, Drive):
            axis["inner_input"][number] |= attached.formulation.acts.timed
        elif PHASES[phase] != "force" and np.isfinite(
            attached.formulation.inner_step_s(attached.values, attached.facts)
        ):
            axis["inner_position"][number] = 1
            axis["inner_reading"][number] |= PHASES[phase] == "reading"


def _group_table(
    robot: Robot, groups: Sequence[Group], axis: TableArray
) -> tuple[TableArray, IntArray]:
    """Return the table of groups and their members; enter the places of the axes."""
    names = tuple(robot.axes)
    table = np.zeros(len(groups), dtype=GROUP)
    table["states"] = [group.states for group in groups]
    table["axes"] = [group.size for group in groups]
    table["first"] = np.cumsum(table["states"]) - table["states"]
    table["member"] = np.cumsum(table["axes"]) - table["axes"]
    members: list[int] = []
    for group, first in zip(groups, table["first"], strict=True):
        own = [names.index(name) for name in group.axes]
        members += own
        if not group.static:
            axis["place"][own] = first + np.arange(group.size)
            axis["rate"][own] = first + group.size + np.arange(group.size)
    return table, np.array(members, dtype=np.int64)


def _output_table(
    robot: Robot, groups: Sequence[Group], group_table: TableArray
) -> tuple[TableArray, IntArray, FloatArray]:
    """Return the table of outputs with their terms: states and weights."""
    names = tuple(robot.axes)
    found: dict[int, tuple[Output, int]] = {}
    for group, first in zip(groups, group_table["first"], strict=True):
        for output in group.outputs:
            place = names.index(output.axis) if output.port is None else len(names) + output.port
            found[place] = output, int(first)
    table = np.zeros(len(found), dtype=OUTPUT)
    states, weights = [np.zeros(0, dtype=np.int64)], [np.zeros(0)]
    for place in range(len(found)):
        output, first = found[place]
        terms = np.flatnonzero(output.weights)
        begin = sum(len(part) for part in states)
        table[place] = (begin, begin + len(terms), output.through, names.index(output.axis))
        states.append(first + terms)
        weights.append(output.weights[terms])
    return table, np.concatenate(states), np.concatenate(weights)


def phase_of(attached: Attached) -> str | None:
    """Return where in the chain an effect's step function is called; None if it has none."""
    acts = attached.formulation.acts
    if isinstance(acts, Drive):
        return "electronics" if attached.effect.stage is Stage.ELECTRONICS else "actuator"
    if isinstance(acts, Reading):
        return "digits" if acts.digital else "reading"
    for kind, phase in ((Force, "force"), (Motion, "motion")):
        if isinstance(acts, kind):
            return phase
    return None


def _ranked(axes: Sequence[str], placed: Sequence[PlacedEffect]) -> list["_Ranked"]:
    """Sort the effects that have a step function by axis and phase; equal ones stay in order."""
    ranked = [
        _Ranked(axes.index(one.attached.asked.axis), PHASES.index(phase), one)
        for one in placed
        if (phase := phase_of(one.attached)) is not None
    ]
    return sorted(ranked, key=lambda entry: entry[:2])


class _Ranked(NamedTuple):
    axis: int
    phase: int
    placed: PlacedEffect


def _numbers(attached: Attached) -> FloatArray:
    try:
        numbers = attached.formulation.numbers(attached.values, attached.facts)
    except EffectError:
        raise
    except Exception as error:  # a plugin may raise anything
        raise _broken(attached, "the numbers of its step function cannot be made", error) from error
    return numbers


def _address(attached: Attached) -> int:
    acts = attached.formulation.acts
    assert isinstance(acts, Drive | Force | Motion | Reading)
    try:
        return address_of(acts.step)
    except Exception as error:  # the compiler, too, on what is no step function
        raise _broken(attached, "its step function cannot be compiled", error) from error


def _broken(attached: Attached, what: str, error: Exception) -> BrokenEffectError:
    reason = next((line for line in str(error).splitlines() if line.strip()), "")
    return BrokenEffectError(
        message(
            "engine", "axis.{axis}.effect {id}: formulation {name}: {what}: {type_name}: {reason}"
        ).fill(
            axis=attached.asked.axis,
            id=attached.asked.id,
            name=repr(attached.formulation.name),
            what=what,
            type_name=type(error).__name__,
            reason=reason,
        )
    )


def states_of(attached: Attached) -> int:
    """Return how much memory an effect's step function has."""
    acts = attached.formulation.acts
    return acts.states if isinstance(acts, Drive | Force | Motion | Reading) else 0


def _random(attached: Attached) -> bool:
    acts = attached.formulation.acts
    return isinstance(acts, Reading) and acts.random
