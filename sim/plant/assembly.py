"""Assembly of a robot and its effects for simulation."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects import (
    AddedStates,
    AttachedEffect,
    AxisChange,
    ClockSkew,
    EffectTrait,
    ForceFunction,
    InputDelay,
    PositionFunction,
    attach_effects,
)
from rotemina.sim.errors import EffectError
from rotemina.sim.messages import format_rounded
from rotemina.sim.plant.coupled_groups import (
    AxisGroup,
    PlacedPart,
    find_coupled_axes,
    make_groups,
    make_static_groups,
)
from rotemina.sim.plant.plant_arrays import (
    PlacedEffect,
    PlantTables,
    count_states,
    find_phase,
    make_tables,
)
from rotemina.sim.plant.settling import needs_settling
from rotemina.sim.robot import Robot


@dataclass(frozen=True, slots=True, eq=False)
class PlantAssembly:
    """A robot and its effects, assembled for simulation.

    Attributes
    ----------
    robot : Robot
        The axes that are simulated, with the changes that effects make to them.
    effects : sequence of AttachedEffect
    groups, all_groups : tuple of AxisGroup
        The groups with dynamics; ``all_groups`` also contains the static axes, at the end.
    tables : PlantTables
    functions : sequence of AttachedEffect
        The effects that have step functions, in the order of the tables.
    delays_s : (axes,)
    skews : mapping of axis number to rate
    inner_step_s : float
    steps_may_grow : bool
        Whether steps may become longer once vibrations have decayed while the input is held.
    """

    robot: Robot
    effects: Sequence[AttachedEffect]
    groups: tuple[AxisGroup, ...]
    all_groups: tuple[AxisGroup, ...]
    tables: PlantTables
    functions: Sequence[AttachedEffect]
    delays_s: FloatArray
    skews: Mapping[int, float]
    inner_step_s: float
    steps_may_grow: bool

    @property
    def has_electronics(self) -> BoolArray:
        """Whether an effect acts between each input and its amplifier's output, (axes,)."""
        changed = {
            effect.entry.axis
            for effect in self.effects
            if isinstance(effect.formulation.acts, InputDelay)
            or find_phase(effect) == "electronics"
        }
        return np.array([name in changed for name in self.robot.axes], dtype=np.bool_)

    @property
    def variate_count(self) -> int:
        """Number of standard normal variates that the effects need at a sample."""
        return int(self.tables.function["variate"].max(initial=-1)) + 1

    @property
    def memory_size(self) -> int:
        """Length of the memory of all step functions."""
        return sum(count_states(effect) for effect in self.functions)

    @property
    def has_memory(self) -> bool:
        """Whether events before the first sample affect the run."""
        states = any(group.states for group in self.all_groups)
        return states or self.memory_size > 0 or bool(self.delays_s.any()) or bool(self.skews)

    @property
    def needs_settling(self) -> bool:
        """Whether the rest position must be found by simulation.

        This is necessary if a force of an effect acts on an axis that settles under its input.
        """
        return any(
            isinstance(effect.formulation.acts, ForceFunction) and needs_settling(effect.facts)
            for effect in self.effects
        )


# Largest real part of a pole, relative to the largest pole, that may come from rounding.
_MAX_GROWTH_RATIO = 1e-9


def assemble(robot: Robot, only: Collection[str] | None = None) -> PlantAssembly:
    """Assemble a robot, or the axes ``only`` and those joined to them by a coupling or an effect.

    Raises
    ------
    EffectError
        If an effect cannot be used, or the robot is unstable with it.
    """
    effects = attach_effects(robot)
    if only is not None:
        joined = _join_axes(robot, effects, only)
        robot = _restrict_robot(robot, joined)
        effects = tuple(effect for effect in effects if effect.entry.axis in joined)
    robot = _change_axes(robot, effects)
    axes = tuple(robot.axes)
    parts, placed = _place_effects(axes, effects)
    groups = make_groups(robot, parts)
    all_groups = groups + make_static_groups(robot, parts)
    _check_stability(all_groups, effects)
    tables, functions = make_tables(robot, all_groups, placed)
    steps = [effect.formulation.inner_step_s(effect.values, effect.facts) for effect in effects]
    return PlantAssembly(
        robot,
        effects,
        groups,
        all_groups,
        tables,
        functions,
        _sum_delays(axes, effects),
        _sum_skews(axes, effects),
        min(steps, default=np.inf),
        not any(_needs_short_steps(effect) for effect in effects),
    )


def _needs_short_steps(effect: AttachedEffect) -> bool:
    """Return whether the effect is a force that has memory or opposes the speed.

    Only short steps let such a force hold an axis.
    """
    formulation = effect.formulation
    return (
        isinstance(formulation.acts, ForceFunction)
        and EffectTrait.MEMORYLESS not in formulation.traits
    )


def _join_axes(robot: Robot, effects: Sequence[AttachedEffect], only: Collection[str]) -> set[str]:
    """Return the axes ``only`` and every axis that moves them or moves with them."""
    joined = set(only)
    groups = find_coupled_axes(robot)
    # Effects and couplings may chain, so axes are added until nothing changes.
    while True:
        sources = {effect.entry.from_axis for effect in effects if effect.entry.axis in joined}
        extended = joined | {name for name in sources if name is not None}
        extended |= {name for group in groups if group & extended for name in group}
        if extended == joined:
            return joined
        joined = extended


def _restrict_robot(robot: Robot, names: Collection[str]) -> Robot:
    return replace(
        robot,
        axes={name: axis for name, axis in robot.axes.items() if name in names},
        couplings=tuple(c for c in robot.couplings if set(c.axes) <= set(names)),
        effects=tuple(e for e in robot.effects if e.axis in names),
        stages={},
    )


def _change_axes(robot: Robot, effects: Sequence[AttachedEffect]) -> Robot:
    axes = dict(robot.axes)
    for effect in effects:
        acts = effect.formulation.acts
        if isinstance(acts, AxisChange):
            axes[effect.entry.axis] = acts.change(effect.values, axes[effect.entry.axis])
    return replace(robot, axes=axes)


def _add_other_position(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add the output of a port, which comes from another axis."""
    return x + other


_PORT_FUNCTION = PositionFunction(step=_add_other_position)


def _place_effects(
    axes: Sequence[str], effects: Sequence[AttachedEffect]
) -> tuple[list[PlacedPart], list[PlacedEffect]]:
    """Return the linear parts and the step functions.

    A linear part that is driven by another axis gets a port: its output goes to a step function on
    the axis that carries the effect.
    """
    parts: list[PlacedPart] = []
    placed: list[PlacedEffect] = []
    port_count = 0
    for effect in effects:
        source = effect.entry.from_axis
        acts = effect.formulation.acts
        if not isinstance(acts, AddedStates):
            placed.append(PlacedEffect(effect, axes.index(source) if source is not None else -1))
        elif source is None:
            parts.append(PlacedPart(effect.entry.axis, acts.part(effect.values, effect.facts)))
        else:
            parts.append(PlacedPart(source, acts.part(effect.values, effect.facts), port_count))
            port_formulation = replace(
                effect.formulation, acts=_PORT_FUNCTION, prepare=_return_no_numbers
            )
            placed.append(
                PlacedEffect(replace(effect, formulation=port_formulation), len(axes) + port_count)
            )
            port_count += 1
    return parts, placed


def _check_stability(groups: Sequence[AxisGroup], effects: Sequence[AttachedEffect]) -> None:
    """Check that no state of axes and effects grows by itself.

    Raises
    ------
    EffectError
        If the axes of a group are unstable together with their effects.
    """
    for group in groups:
        group_effects = [
            effect
            for effect in effects
            if {effect.entry.axis, effect.entry.from_axis} & set(group.axes)
        ]
        if not group_effects or group.states == 0:
            continue
        poles = np.linalg.eigvals(group.generator[: group.states, : group.states])
        growth_rate = float(poles.real.max())
        if growth_rate > _MAX_GROWTH_RATIO * float(np.abs(poles).max()):
            description = "; ".join(
                f"{effect.entry.id} on {effect.entry.axis} with "
                + ", ".join(f"{name} = {value:g}" for name, value in effect.values.items())
                for effect in group_effects
                if isinstance(effect.formulation.acts, AddedStates | AxisChange)
            )
            raise EffectError(
                "axis {names}: unstable with these effects: {named}. A motion grows by a "
                "factor of e every {fastest} s; change or remove one of them",
                names=", ".join(group.axes),
                fastest=format_rounded(1.0 / growth_rate, 3),
                named=description,
            )


def _return_no_numbers(_values: object, _facts: object) -> tuple[float, ...]:
    return ()


def _sum_delays(axes: Sequence[str], effects: Sequence[AttachedEffect]) -> FloatArray:
    delays = np.zeros(len(axes))
    for effect in effects:
        if isinstance(effect.formulation.acts, InputDelay):
            delays[axes.index(effect.entry.axis)] += effect.formulation.acts.delay_s(effect.values)
    return delays


def _sum_skews(axes: Sequence[str], effects: Sequence[AttachedEffect]) -> dict[int, float]:
    skews: dict[int, float] = {}
    for effect in effects:
        if isinstance(effect.formulation.acts, ClockSkew):
            column = axes.index(effect.entry.axis)
            skews[column] = skews.get(column, 0.0) + effect.formulation.acts.rate(effect.values)
    return skews
