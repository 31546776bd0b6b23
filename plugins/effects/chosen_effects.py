"""Effects chosen by the operator, in signal-flow order. Does not use Qt."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Self

from rotemina.sim.effects import AttachedEffect, Effect, EffectStage
from rotemina.sim.errors import EffectError
from rotemina.sim.robot import AxisEffect, Robot

_STAGE_ORDER = list(EffectStage)


@dataclass(frozen=True, slots=True)
class ChosenEffects:
    """Valid effects of a robot, sorted by axis and stage.

    Within a stage, the operator chooses the order.
    """

    robot: Robot
    effects: tuple[AttachedEffect, ...] = ()

    @classmethod
    def from_effects(cls, robot: Robot, requests: Iterable[AxisEffect]) -> Self:
        """Check the requested effects and sort them.

        Raises
        ------
        EffectError
            If an effect is invalid; it names axis, effect, parameter, value and bound.
        """
        axes = list(robot.axes)
        effects = [AttachedEffect.of(robot, request) for request in requests]
        effects.sort(
            key=lambda attached: (
                axes.index(attached.entry.axis),
                _STAGE_ORDER.index(attached.effect.stage),
            )
        )
        return cls(robot, tuple(effects))

    def __len__(self) -> int:
        return len(self.effects)

    @property
    def requests(self) -> tuple[AxisEffect, ...]:
        """The effects in the form that robot files and simulators use."""
        return tuple(attached.entry for attached in self.effects)

    @property
    def disabled_requests(self) -> tuple[AxisEffect, ...]:
        """The same effects, all switched off."""
        return tuple(replace(request, enabled=False) for request in self.requests)

    def with_effect(self, request: AxisEffect) -> tuple[Self, int]:
        """Return a copy with one more effect, the last one of its stage, and its index."""
        chain = type(self).from_effects(self.robot, (*self.requests, request))
        indices = [index for index, other in enumerate(chain.requests) if other is request]
        return chain, indices[-1]

    def without_effect(self, index: int) -> Self:
        """Return a copy without one of the effects."""
        return replace(self, effects=self.effects[:index] + self.effects[index + 1 :])

    def with_replacement(self, index: int, request: AxisEffect) -> Self:
        """Return a copy in which one effect is replaced by another of the same axis and stage.

        Raises
        ------
        EffectError
            If the effect is invalid; it names axis, effect, parameter, value and bound.
        """
        replacement = AttachedEffect.of(self.robot, request)
        return replace(
            self, effects=(*self.effects[:index], replacement, *self.effects[index + 1 :])
        )

    def find_neighbour(self, index: int, step: int) -> int | None:
        """Return the index of the previous (−1) or next (+1) effect of the same axis and stage.

        Return None if there is no such effect.
        """
        neighbour_index = index + step
        if not 0 <= neighbour_index < len(self.effects):
            return None
        attached, neighbour = self.effects[index], self.effects[neighbour_index]
        is_same_stage = (
            attached.entry.axis == neighbour.entry.axis
            and attached.effect.stage is neighbour.effect.stage
        )
        return neighbour_index if is_same_stage else None

    def with_swap(self, index: int, other: int) -> Self:
        """Return a copy with two effects swapped."""
        effects = list(self.effects)
        effects[index], effects[other] = effects[other], effects[index]
        return replace(self, effects=tuple(effects))


def with_value(effect: AttachedEffect, name: str, value: float) -> AxisEffect:
    """Return the effect with another value (SI) of one parameter."""
    return replace(effect.entry, parameters={**effect.entry.parameters, name: value})


def with_formulation(effect: AttachedEffect, name: str) -> AxisEffect:
    """Return the effect with another formulation.

    Parameters that both formulations have keep their values, clipped to the new bounds.
    """
    formulation = effect.effect.find_formulation(name)
    assert formulation is not None, "chosen from the formulations of the effect"
    parameters: dict[str, float] = {}
    for key, value in effect.entry.parameters.items():
        parameter = formulation.find_parameter(key)
        if parameter is not None:
            low, high = parameter.bounds(effect.facts)
            parameters[key] = min(max(value, low), high)
    return replace(effect.entry, formulation=name, parameters=parameters)


def find_candidates(robot: Robot, axis: str, effects: Mapping[str, Effect]) -> dict[str, list[str]]:
    """Return the effects that an axis can have, as effect id -> names of possible formulations."""
    others = [name for name in robot.axes if name != axis]
    formulation_names: dict[str, list[str]] = {}
    for effect in effects.values():
        source = others[0] if effect.coupled and others else None
        for formulation in effect.formulations:
            request = AxisEffect(
                axis=axis, id=effect.id, formulation=formulation.name, from_axis=source
            )
            try:
                AttachedEffect.of(robot, request)
            except EffectError:
                continue
            formulation_names.setdefault(effect.id, []).append(formulation.name)
    return formulation_names
