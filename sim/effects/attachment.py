"""Effects on the axes of a robot: the entries of a robot file, checked.

In a robot file::

    [[axis.thx.effect]]
    id = "hysteresis"
    formulation = "bouc_wen"    # the usual one without
    width = 1.1e-4              # parameters, SI; those left out have their preset
    from_axis = "thy"           # for effects that come from another axis
    enabled = true
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Self

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import Change, Effect, Force, Formulation, Parameter
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Axis, AxisEffect, Robot

RESERVED = ("id", "formulation", "from_axis", "enabled")
_SLACK = 1e-9  # of bounds: a value may have been printed and read on its way


@dataclass(frozen=True, slots=True, eq=False)
class Attached:
    """An effect on an axis, with everything that its simulation needs."""

    asked: AxisEffect
    effect: Effect
    formulation: Formulation
    facts: Facts

    @classmethod
    def of(cls, robot: Robot, asked: AxisEffect) -> Self:
        """Look up and check one effect of a robot.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound.
        """
        where = f"axis.{asked.axis}.effect {asked.id}"
        try:
            effect = effect_named(asked.id)
        except EffectError as error:
            raise EffectError(
                message("engine", "{where}: {error}").fill(where=where, error=str(error))
            ) from error
        axis = robot.axes.get(asked.axis)
        if axis is None:
            raise EffectError(
                message("engine", "{where}: the robot has no such axis; it has {axes}").fill(
                    where=where, axes=", ".join(robot.axes)
                )
            )
        formulation = _formulation(effect, asked.formulation, where)
        _check_place(effect, formulation, axis, where)
        _check_source(effect, asked, robot, where)
        facts = Facts.of(axis)
        for name, value in asked.parameters.items():
            _check_value(formulation, name, value, facts, where)
        return cls(asked, effect, formulation, facts)

    @property
    def values(self) -> dict[str, float]:
        """All parameters by name, SI, presets included."""
        given = self.asked.parameters
        return {
            p.name: float(given.get(p.name, p.preset(self.facts)))
            for p in self.formulation.parameters
        }

    def clipped(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return values of parameters, SI, those beyond a bound at it.

        Raises
        ------
        EffectError
            If the formulation has no such parameter.
        """
        within = {}
        for name, value in values.items():
            parameter = self.formulation.parameter(name)
            if parameter is None:
                raise EffectError(_no_such(self.formulation, name, value, self.asked.id))
            low, high = parameter.bounds(self.facts)
            within[name] = min(max(float(value), low), high)
        return within

    def __str__(self) -> str:
        source = f" from {self.asked.from_axis}" if self.asked.from_axis is not None else ""
        values = "".join(f"; {name} = {value!r}" for name, value in self.values.items())
        return f"{self.asked.id} on {self.asked.axis}{source}; {self.formulation.name}{values}"


def attached_effects(robot: Robot) -> tuple[Attached, ...]:
    """Return the enabled effects of a robot, in its order.

    Raises
    ------
    EffectError
        With axis, effect, parameter, value and bound.
    """
    return tuple(Attached.of(robot, asked) for asked in robot.effects if asked.enabled)


def parse_effect(axis: str, table: Mapping[str, Any]) -> AxisEffect:
    """Read one ``[[axis.NAME.effect]]`` table; bounds are checked by :meth:`Attached.of`.

    Raises
    ------
    EffectError
        If a key is missing or of the wrong type.
    """
    where = f"axis.{axis}.effect"
    effect_id = table.get("id")
    if not isinstance(effect_id, str):
        raise EffectError(
            message("engine", "{where}.id = {effect_id}: must be the id of an effect, a text").fill(
                where=where, effect_id=repr(effect_id)
            )
        )
    where = f"{where} {effect_id}"
    formulation, from_axis = table.get("formulation"), table.get("from_axis")
    for key, text in (("formulation", formulation), ("from_axis", from_axis)):
        if text is not None and not isinstance(text, str):
            raise EffectError(
                message("engine", "{where}.{key} = {text}: must be a text").fill(
                    where=where, key=key, text=repr(text)
                )
            )
    enabled = table.get("enabled", True)
    if not isinstance(enabled, bool):
        raise EffectError(
            message("engine", "{where}.enabled = {enabled}: must be true or false").fill(
                where=where, enabled=repr(enabled)
            )
        )
    parameters = {key: value for key, value in table.items() if key not in RESERVED}
    for key, value in parameters.items():
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise EffectError(
                message("engine", "{where}.{key} = {value}: must be a number").fill(
                    where=where, key=key, value=repr(value)
                )
            )
    return AxisEffect(
        axis=axis,
        id=effect_id,
        formulation=formulation,
        parameters={key: float(value) for key, value in parameters.items()},
        from_axis=from_axis,
        enabled=enabled,
    )


def _formulation(effect: Effect, name: str | None, where: str) -> Formulation:
    formulation = effect.formulation(name)
    if formulation is None:
        known = ", ".join(f.name for f in effect.formulations)
        raise EffectError(
            message("engine", "{where}.formulation = {name}: must be one of {known}").fill(
                where=where, name=repr(name), known=known
            )
        )
    return formulation


def _check_place(effect: Effect, formulation: Formulation, axis: Axis, where: str) -> None:
    for kinds, what in ((effect.kinds, ""), (formulation.kinds, f" as {formulation.name!r}")):
        if kinds and axis.kind not in kinds:
            raise EffectError(
                message(
                    "engine",
                    "{where}{what}: acts on axes of kind {names}; this one is of kind {kind}",
                ).fill(where=where, what=what, names=", ".join(sorted(kinds)), kind=repr(axis.kind))
            )
    if axis.static and isinstance(formulation.acts, Force | Change):
        raise EffectError(
            message(
                "engine",
                "{where}: formulation {name} acts on the dynamics of an axis, but this one "
                "is static; give it mass, damping and stiffness, or choose another formulation",
            ).fill(where=where, name=repr(formulation.name))
        )


def _check_source(effect: Effect, asked: AxisEffect, robot: Robot, where: str) -> None:
    if not effect.coupled:
        if asked.from_axis is not None:
            raise EffectError(
                message(
                    "engine",
                    "{where}.from_axis = {from_axis}: this effect comes from no other axis; remove "
                    "it",
                ).fill(where=where, from_axis=repr(asked.from_axis))
            )
        return
    others = [name for name in robot.axes if name != asked.axis]
    if asked.from_axis not in others:
        raise EffectError(
            message("engine", "{where}.from_axis = {from_axis}: must be one of {others}").fill(
                where=where, from_axis=repr(asked.from_axis), others=str(others)
            )
        )


def _check_value(
    formulation: Formulation, name: str, value: float, facts: Facts, where: str
) -> None:
    parameter = formulation.parameter(name)
    if parameter is None:
        raise EffectError(_no_such(formulation, name, value, where))
    low, high = parameter.bounds(facts)
    slack = _SLACK * max((abs(end) for end in (low, high) if isfinite(end)), default=0.0)
    if not isfinite(value) or not low - slack <= value <= high + slack:
        raise EffectError(
            message("engine", "{where}.{name} = {beyond}").fill(
                where=where, name=name, beyond=_beyond(parameter, value, facts)
            )
        )


def _no_such(formulation: Formulation, name: str, value: float, where: str) -> str:
    known = ", ".join(p.name for p in formulation.parameters)
    return (
        f"{where}.{name} = {value:g}: formulation {formulation.name!r} has no such parameter; "
        f"it has {known}"
    )


def _beyond(parameter: Parameter, value: float, facts: Facts) -> str:
    """Tell of a value out of bounds, with all digits where few would make it seem within them."""
    numbers = (value, *parameter.bounds(facts))
    short = [f"{number:g}" for number in numbers]
    if short[0] in short[1:]:
        short = [f"{number:.17g}" for number in numbers]
    told, low, high = short
    return f"{told}: must be between {low} and {high} {parameter.unit_on(facts)}".rstrip()
