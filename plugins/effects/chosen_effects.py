"""The effects chosen by an operator, in signal order. Free of Qt."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Self

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.formulation import Effect, Stage
from rotemina.sim.robot.model import AxisEffect, Robot

_STAGES = list(Stage)


@dataclass(frozen=True, slots=True)
class Chain:
    """Checked effects of a robot: axis by axis, stage by stage, then in the operator's order."""

    robot: Robot
    effects: tuple[Attached, ...] = ()

    @classmethod
    def of(cls, robot: Robot, asked: Iterable[AxisEffect]) -> Self:
        """Look effects up and put them in order.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound.
        """
        axes = list(robot.axes)
        effects = [Attached.of(robot, one) for one in asked]
        effects.sort(key=lambda one: (axes.index(one.asked.axis), _STAGES.index(one.effect.stage)))
        return cls(robot, tuple(effects))

    def __len__(self) -> int:
        return len(self.effects)

    @property
    def asked(self) -> tuple[AxisEffect, ...]:
        """The effects for robot files and simulators."""
        return tuple(one.asked for one in self.effects)

    @property
    def silent(self) -> tuple[AxisEffect, ...]:
        """The same, every one switched off."""
        return tuple(replace(one, enabled=False) for one in self.asked)

    def added(self, asked: AxisEffect) -> tuple[Self, int]:
        """Return the chain with one more effect, the last of its stage, and its place."""
        chain = type(self).of(self.robot, (*self.asked, asked))
        places = [i for i, one in enumerate(chain.asked) if one is asked]
        return chain, places[-1]

    def removed(self, place: int) -> Self:
        """Return the chain without one of its effects."""
        return replace(self, effects=self.effects[:place] + self.effects[place + 1 :])

    def changed(self, place: int, asked: AxisEffect) -> Self:
        """Return the chain with one effect of the same axis and stage in place of another.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound.
        """
        one = Attached.of(self.robot, asked)
        return replace(self, effects=(*self.effects[:place], one, *self.effects[place + 1 :]))

    def neighbour(self, place: int, step: int) -> int | None:
        """Return the place of the effect before (−1) or after (+1) on the same axis and stage."""
        other = place + step
        if not 0 <= other < len(self.effects):
            return None
        one, next_one = self.effects[place], self.effects[other]
        same = one.asked.axis == next_one.asked.axis and one.effect.stage is next_one.effect.stage
        return other if same else None

    def swapped(self, place: int, other: int) -> Self:
        """Return the chain with two of its effects in each other's place."""
        effects = list(self.effects)
        effects[place], effects[other] = effects[other], effects[place]
        return replace(self, effects=tuple(effects))


def with_value(one: Attached, name: str, value: float) -> AxisEffect:
    """Return the effect with another value (SI) of one parameter."""
    return replace(one.asked, parameters={**one.asked.parameters, name: value})


def with_formulation(one: Attached, name: str) -> AxisEffect:
    """Return the effect with another formulation; common parameters keep their values."""
    formulation = one.effect.formulation(name)
    assert formulation is not None, "chosen from those that there are"
    kept: dict[str, float] = {}
    for key, value in one.asked.parameters.items():
        parameter = formulation.parameter(key)
        if parameter is not None:
            low, high = parameter.bounds(one.facts)
            kept[key] = min(max(value, low), high)
    return replace(one.asked, formulation=name, parameters=kept)


def candidates(robot: Robot, axis: str, effects: Mapping[str, Effect]) -> dict[str, list[str]]:
    """Return the effects that may sit on an axis, id -> names of the formulations that may."""
    others = [name for name in robot.axes if name != axis]
    found: dict[str, list[str]] = {}
    for effect in effects.values():
        source = others[0] if effect.coupled and others else None
        for formulation in effect.formulations:
            asked = AxisEffect(
                axis=axis, id=effect.id, formulation=formulation.name, from_axis=source
            )
            try:
                Attached.of(robot, asked)
            except EffectError:
                continue
            found.setdefault(effect.id, []).append(formulation.name)
    return found
