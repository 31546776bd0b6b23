"""Effects on the axes of a robot: the checked entries of a robot file.

In a robot file::

    [[axis.thx.effect]]
    id = "hysteresis"
    formulation = "bouc_wen"    # default: the first one of the effect
    width = 1.1e-4              # parameters, SI; omitted ones have their presets
    from_axis = "thy"           # only for effects caused by another axis
    enabled = true
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Self

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    AxisChange,
    Effect,
    EffectParameter,
    ForceFunction,
    Formulation,
)
from rotemina.sim.effects.registry import load_effect
from rotemina.sim.errors import EffectError
from rotemina.sim.robot import (
    Axis,
    AxisEffect,
    Robot,
)

RESERVED_KEYS = ("id", "formulation", "from_axis", "enabled")
# Relative tolerance of the bounds: a value that is printed and read back may pass its bound.
_BOUND_SLACK_RATIO = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class AttachedEffect:
    """Effect on an axis, with everything that its simulation needs.

    ``entry`` is the effect as a robot file requests it.
    """

    entry: AxisEffect
    effect: Effect
    formulation: Formulation
    facts: AxisProperties

    @classmethod
    def of(cls, robot: Robot, entry: AxisEffect) -> Self:
        """Look up and check one effect of a robot.

        Raises
        ------
        EffectError
            If the effect cannot act on its axis, or a parameter is unknown or out of bounds. The
            message gives axis, effect, parameter, value and bound.
        """
        where = f"axis.{entry.axis}.effect {entry.id}"
        try:
            effect = load_effect(entry.id)
        except EffectError as error:
            raise EffectError("{where}: {error}", where=where, error=str(error)) from error
        axis = robot.axes.get(entry.axis)
        if axis is None:
            raise EffectError(
                "{where}: the robot has no such axis; it has {axes}",
                where=where,
                axes=", ".join(robot.axes),
            )
        formulation = _find_formulation(effect, entry.formulation, where)
        _check_axis_kind(effect, formulation, axis, where)
        _check_source(effect, entry, robot, where)
        facts = AxisProperties.of(axis)
        for name, value in entry.parameters.items():
            _check_value(formulation, name, value, facts, where)
        return cls(entry, effect, formulation, facts)

    @property
    def values(self) -> dict[str, float]:
        """All parameters by name, SI, presets included."""
        parameters = self.entry.parameters
        return {
            p.name: float(parameters.get(p.name, p.preset(self.facts)))
            for p in self.formulation.parameters
        }

    def clip_values(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return values of parameters, SI, clipped to their bounds.

        Raises
        ------
        EffectError
            If the formulation has no such parameter.
        """
        clipped = {}
        for name, value in values.items():
            parameter = self.formulation.find_parameter(name)
            if parameter is None:
                raise EffectError(
                    _describe_unknown_parameter(self.formulation, name, value, self.entry.id)
                )
            low, high = parameter.bounds(self.facts)
            clipped[name] = min(max(float(value), low), high)
        return clipped

    def __str__(self) -> str:
        source = f" from {self.entry.from_axis}" if self.entry.from_axis is not None else ""
        values = "".join(f"; {name} = {value!r}" for name, value in self.values.items())
        return f"{self.entry.id} on {self.entry.axis}{source}; {self.formulation.name}{values}"


def attach_effects(robot: Robot) -> tuple[AttachedEffect, ...]:
    """Check the enabled effects of a robot and return them in the order of the robot.

    Raises
    ------
    EffectError
        If an effect cannot act on its axis, or a parameter is unknown or out of bounds. The message
        gives axis, effect, parameter, value and bound.
    """
    return tuple(AttachedEffect.of(robot, entry) for entry in robot.effects if entry.enabled)


def parse_effect(axis: str, table: Mapping[str, Any]) -> AxisEffect:
    """Read one ``[[axis.NAME.effect]]`` table; :meth:`AttachedEffect.of` checks the bounds.

    Raises
    ------
    EffectError
        If a key is missing or of the wrong type.
    """
    where = f"axis.{axis}.effect"
    effect_id = table.get("id")
    if not isinstance(effect_id, str):
        raise EffectError(
            "{where}.id = {effect_id}: must be the id of an effect, a text",
            where=where,
            effect_id=repr(effect_id),
        )
    where = f"{where} {effect_id}"
    formulation, from_axis = table.get("formulation"), table.get("from_axis")
    for key, text in (("formulation", formulation), ("from_axis", from_axis)):
        if text is not None and not isinstance(text, str):
            raise EffectError(
                "{where}.{key} = {text}: must be a text", where=where, key=key, text=repr(text)
            )
    enabled = table.get("enabled", True)
    if not isinstance(enabled, bool):
        raise EffectError(
            "{where}.enabled = {enabled}: must be true or false", where=where, enabled=repr(enabled)
        )
    parameters = {key: value for key, value in table.items() if key not in RESERVED_KEYS}
    for key, value in parameters.items():
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise EffectError(
                "{where}.{key} = {value}: must be a number", where=where, key=key, value=repr(value)
            )
    return AxisEffect(
        axis=axis,
        id=effect_id,
        formulation=formulation,
        parameters={key: float(value) for key, value in parameters.items()},
        from_axis=from_axis,
        enabled=enabled,
    )


def _find_formulation(effect: Effect, name: str | None, where: str) -> Formulation:
    formulation = effect.find_formulation(name)
    if formulation is None:
        known_names = ", ".join(f.name for f in effect.formulations)
        raise EffectError(
            "{where}.formulation = {name}: must be one of {known}",
            where=where,
            name=repr(name),
            known=known_names,
        )
    return formulation


def _check_axis_kind(effect: Effect, formulation: Formulation, axis: Axis, where: str) -> None:
    for kinds, suffix in ((effect.kinds, ""), (formulation.kinds, f" as {formulation.name!r}")):
        if kinds and axis.kind not in kinds:
            raise EffectError(
                "{where}{what}: acts on axes of kind {names}; this one is of kind {kind}",
                where=where,
                what=suffix,
                names=", ".join(sorted(kinds)),
                kind=repr(axis.kind),
            )
    if axis.static and isinstance(formulation.acts, ForceFunction | AxisChange):
        raise EffectError(
            "{where}: formulation {name} acts on the dynamics of an axis, but this one "
            "is static; give it mass, damping and stiffness, or choose another formulation",
            where=where,
            name=repr(formulation.name),
        )


def _check_source(effect: Effect, entry: AxisEffect, robot: Robot, where: str) -> None:
    if not effect.coupled:
        if entry.from_axis is not None:
            raise EffectError(
                "{where}.from_axis = {from_axis}: no other axis causes this effect; remove "
                "from_axis",
                where=where,
                from_axis=repr(entry.from_axis),
            )
        return
    others = [name for name in robot.axes if name != entry.axis]
    if entry.from_axis not in others:
        raise EffectError(
            "{where}.from_axis = {from_axis}: must be one of {others}",
            where=where,
            from_axis=repr(entry.from_axis),
            others=str(others),
        )


def _check_value(
    formulation: Formulation, name: str, value: float, facts: AxisProperties, where: str
) -> None:
    parameter = formulation.find_parameter(name)
    if parameter is None:
        raise EffectError(_describe_unknown_parameter(formulation, name, value, where))
    low, high = parameter.bounds(facts)
    slack = _BOUND_SLACK_RATIO * max(
        (abs(end) for end in (low, high) if isfinite(end)), default=0.0
    )
    if not isfinite(value) or not low - slack <= value <= high + slack:
        raise EffectError(
            "{where}.{name} = {beyond}",
            where=where,
            name=name,
            beyond=_describe_value_out_of_bounds(parameter, value, facts),
        )


def _describe_unknown_parameter(
    formulation: Formulation, name: str, value: float, where: str
) -> str:
    known_names = ", ".join(p.name for p in formulation.parameters)
    return (
        f"{where}.{name} = {value:g}: formulation {formulation.name!r} has no such parameter; "
        f"it has {known_names}"
    )


def _describe_value_out_of_bounds(
    parameter: EffectParameter, value: float, facts: AxisProperties
) -> str:
    """Describe a value out of bounds; print all digits if few would show it equal to a bound."""
    numbers = (value, *parameter.bounds(facts))
    texts = [f"{number:g}" for number in numbers]
    if texts[0] in texts[1:]:
        texts = [f"{number:.17g}" for number in numbers]
    text, low, high = texts
    return f"{text}: must be between {low} and {high} {parameter.unit_on(facts)}".rstrip()
