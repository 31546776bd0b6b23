"""A robot and its effects put together for simulation."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects.attachment import Attached, attached_effects
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.formulation import (
    Change,
    Force,
    Late,
    Motion,
    Part,
    Skew,
    Trait,
)
from rotemina.sim.messages import message
from rotemina.sim.plant.coupled_groups import (
    Group,
    PlacedPart,
    coupled_axes,
    groups_of,
    static_groups_of,
)
from rotemina.sim.plant.plant_arrays import (
    Machine,
    PlacedEffect,
    machine_of,
    phase_of,
    states_of,
)
from rotemina.sim.plant.settling import is_led
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import Robot


@dataclass(frozen=True, slots=True, eq=False)
class Assembly:
    """What a plant is made of.

    Attributes
    ----------
    robot : Robot
        The axes that are simulated, changed where an effect changes them.
    effects : sequence of Attached
    groups, all_groups : tuple of Group
        Those with dynamics; with the static axes behind them.
    machine : Machine
    functions : sequence of Attached
        The effects that have step functions, in their order.
    delays_s : (axes,)
    skews : mapping of axis number to rate
    inner_step_s : float
    steps_may_grow : bool
        Whether longer steps do, once nothing rings in a hold any more.
    """

    robot: Robot
    effects: Sequence[Attached]
    groups: tuple[Group, ...]
    all_groups: tuple[Group, ...]
    machine: Machine
    functions: Sequence[Attached]
    delays_s: FloatArray
    skews: Mapping[int, float]
    inner_step_s: float
    steps_may_grow: bool

    @property
    def electronics(self) -> BoolArray:
        """Whether an effect lies between each input and its amplifier's output, (axes,)."""
        changed = {
            one.asked.axis
            for one in self.effects
            if isinstance(one.formulation.acts, Late) or phase_of(one) == "electronics"
        }
        return np.array([name in changed for name in self.robot.axes], dtype=np.bool_)

    @property
    def random(self) -> int:
        """How many standard normal variates the effects need at a sample."""
        return int(self.machine.function["variate"].max(initial=-1)) + 1

    @property
    def memory(self) -> int:
        """Length of the memory of all step functions."""
        return sum(states_of(one) for one in self.functions)

    @property
    def remembers(self) -> bool:
        """Whether what happened before the first sample matters after it."""
        states = any(group.states for group in self.all_groups)
        return states or self.memory > 0 or bool(self.delays_s.any()) or bool(self.skews)

    @property
    def leads_in(self) -> bool:
        """Whether rest is to be found by simulation: a force of an effect acts on a held axis."""
        return any(
            isinstance(one.formulation.acts, Force) and is_led(one.facts) for one in self.effects
        )


_GROWTH = 1e-9  # of a pole, over the fastest: rounding may put one that stands still there


def assemble(robot: Robot, only: Collection[str] | None = None) -> Assembly:
    """Put the axes ``only``, and those that a coupling or an effect joins to them, together.

    Raises
    ------
    EffectError
        If an effect cannot be used, or the robot is unstable with it.
    """
    effects = attached_effects(robot)
    if only is not None:
        joined = _joined(robot, effects, only)
        robot = _restricted(robot, joined)
        effects = tuple(one for one in effects if one.asked.axis in joined)
    robot = _changed(robot, effects)
    axes = tuple(robot.axes)
    parts, placed = _placed(axes, effects)
    groups = groups_of(robot, parts)
    all_groups = groups + static_groups_of(robot, parts)
    _check_stability(all_groups, effects)
    machine, functions = machine_of(robot, all_groups, placed)
    steps = [one.formulation.inner_step_s(one.values, one.facts) for one in effects]
    return Assembly(
        robot,
        effects,
        groups,
        all_groups,
        machine,
        functions,
        _delays(axes, effects),
        _skews(axes, effects),
        min(steps, default=np.inf),
        not any(_sticks(one) for one in effects),
    )


def _sticks(one: Attached) -> bool:
    """Whether a force remembers or opposes speed: it holds an axis in short steps alone."""
    formulation = one.formulation
    return isinstance(formulation.acts, Force) and Trait.MEMORYLESS not in formulation.traits


def _joined(robot: Robot, effects: Sequence[Attached], only: Collection[str]) -> set[str]:
    """Return ``only`` and every axis that moves them or moves with them."""
    joined = set(only)
    groups = coupled_axes(robot)
    while True:
        sources = {one.asked.from_axis for one in effects if one.asked.axis in joined}
        more = joined | {name for name in sources if name is not None}
        more |= {name for group in groups if group & more for name in group}
        if more == joined:
            return joined
        joined = more


def _restricted(robot: Robot, names: Collection[str]) -> Robot:
    """Return the robot with some of its axes alone."""
    return replace(
        robot,
        axes={name: axis for name, axis in robot.axes.items() if name in names},
        couplings=tuple(c for c in robot.couplings if set(c.axes) <= set(names)),
        effects=tuple(e for e in robot.effects if e.axis in names),
        stages={},
    )


def _changed(robot: Robot, effects: Sequence[Attached]) -> Robot:
    axes = dict(robot.axes)
    for one in effects:
        acts = one.formulation.acts
        if isinstance(acts, Change):
            axes[one.asked.axis] = acts.change(one.values, axes[one.asked.axis])
    return replace(robot, axes=axes)


def _leak(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add what comes from another axis."""
    return x + other


_LEAK = Motion(step=_leak)


def _placed(
    axes: Sequence[str], effects: Sequence[Attached]
) -> tuple[list[PlacedPart], list[PlacedEffect]]:
    """Return the linear parts, and the step functions with what they see of other axes."""
    parts: list[PlacedPart] = []
    placed: list[PlacedEffect] = []
    ports = 0
    for one in effects:
        source = one.asked.from_axis
        acts = one.formulation.acts
        if not isinstance(acts, Part):
            placed.append(PlacedEffect(one, axes.index(source) if source is not None else -1))
        elif source is None:
            parts.append(PlacedPart(one.asked.axis, acts.part(one.values, one.facts)))
        else:
            parts.append(PlacedPart(source, acts.part(one.values, one.facts), ports))
            leaking = replace(one.formulation, acts=_LEAK, prepare=_no_numbers)
            placed.append(PlacedEffect(replace(one, formulation=leaking), len(axes) + ports))
            ports += 1
    return parts, placed


def _check_stability(groups: Sequence[Group], effects: Sequence[Attached]) -> None:
    """Refuse states of axes and of effects that grow by themselves."""
    for group in groups:
        own = [one for one in effects if {one.asked.axis, one.asked.from_axis} & set(group.axes)]
        if not own or group.states == 0:
            continue
        poles = np.linalg.eigvals(group.generator[: group.states, : group.states])
        fastest = float(poles.real.max())
        if fastest > _GROWTH * float(np.abs(poles).max()):
            named = "; ".join(
                f"{one.asked.id} on {one.asked.axis} with "
                + ", ".join(f"{name} = {value:g}" for name, value in one.values.items())
                for one in own
                if isinstance(one.formulation.acts, Part | Change)
            )
            raise EffectError(
                message(
                    "engine",
                    "axis {names}: unstable together, a motion grows by e every {fastest} s "
                    "({named}); change or remove one of them",
                ).fill(names=", ".join(group.axes), fastest=rounded(1.0 / fastest, 3), named=named)
            )


def _no_numbers(_values: object, _facts: object) -> tuple[float, ...]:
    return ()


def _delays(axes: Sequence[str], effects: Sequence[Attached]) -> FloatArray:
    delays = np.zeros(len(axes))
    for one in effects:
        if isinstance(one.formulation.acts, Late):
            delays[axes.index(one.asked.axis)] += one.formulation.acts.delay_s(one.values)
    return delays


def _skews(axes: Sequence[str], effects: Sequence[Attached]) -> dict[int, float]:
    skews: dict[int, float] = {}
    for one in effects:
        if isinstance(one.formulation.acts, Skew):
            column = axes.index(one.asked.axis)
            skews[column] = skews.get(column, 0.0) + one.formulation.acts.rate(one.values)
    return skews
