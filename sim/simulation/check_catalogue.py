"""Checks of what an effect says of itself."""

from collections.abc import Iterator
from dataclasses import fields
from math import isfinite, isnan

from rotemina.sim.effects.attachment import RESERVED
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import EVERY_KIND, Effect, Formulation, Parameter, Stage
from rotemina.sim.simulation.check_bench import Bench
from rotemina.sim.simulation.check_result import Check, stated

#: What a unit may be made of; q, u and N stand for those of the axis.
UNITS = frozenset(
    ("q", "u", "N", "m", "rad", "s", "Hz", "V", "A", "K", "W", "J", "F", "C", "Ω", "ppm", "dB")
)
_PREFIXES = "pnµmkMG"
_SIGNS = set(" …/·*√^²³⁻¹()0123456789.-%")


def check_catalogue(effect: Effect) -> Iterator[Check]:
    """Check an effect's facts, and those of its formulations."""
    yield stated("effect is described", list(_effect_faults(effect)))
    for formulation in effect.formulations:
        found = stated("formulation is described", list(_formulation_faults(formulation)))
        yield Check(
            found.name, found.passed, found.value, found.bound, found.note, formulation.name
        )


def check_bounds(bench: Bench) -> Check:
    """Check that presets are taken, and that what lies beyond a bound is refused."""
    faults = []
    try:
        bench.attach()
    except EffectError as error:
        faults.append(f"its presets are refused: {error}")
    for parameter in bench.formulation.parameters:
        low, high = parameter.bounds(bench.facts)
        margin = 1e-3 * max(abs(low) if isfinite(low) else 0.0, abs(high) if isfinite(high) else 0)
        beyond = [end for end in (low - (margin or 1.0), high + (margin or 1.0)) if isfinite(end)]
        for value in [*beyond, float("nan")]:
            try:
                bench.attach({parameter.name: value})
            except EffectError:
                continue
            faults.append(f"{parameter.name} = {value:g} is not refused")
    return stated("values beyond bounds are refused", faults)


def _effect_faults(effect: Effect) -> Iterator[str]:
    for name in ("id", "title", "summary"):
        if not str(getattr(effect, name)).strip():
            yield f"its {name} is empty"
    if not effect.id.replace("_", "").isalnum() or effect.id != effect.id.lower():
        yield f"its id {effect.id!r} is not made of small letters, digits and _"
    if not isinstance(effect.stage, Stage):
        yield f"its stage {effect.stage!r} is none of {', '.join(Stage)}"
    if not effect.kinds or not effect.kinds <= EVERY_KIND:
        yield f"its kinds {sorted(effect.kinds)} are not among {sorted(EVERY_KIND)}"
    names = [formulation.name for formulation in effect.formulations]
    if not names:
        yield "it has no formulation"
    yield from _twice("formulation", names)


def _formulation_faults(formulation: Formulation) -> Iterator[str]:
    for name in ("name", "equation", "source"):
        if not str(getattr(formulation, name)).strip():
            yield f"its {name} is empty"
    if not formulation.parameters:
        yield "it has no parameter"
    yield from _twice("parameter", [parameter.name for parameter in formulation.parameters])
    for parameter in formulation.parameters:
        for fault in _parameter_faults(parameter):
            yield f"{parameter.name}: {fault}"


def _parameter_faults(parameter: Parameter) -> Iterator[str]:
    if not parameter.name.isidentifier() or parameter.name in RESERVED:
        yield "is no name of a parameter"
    if not parameter.meaning.strip():
        yield "its meaning is empty"
    numbers = (parameter.low, parameter.typical, parameter.high)
    if any(map(isnan, numbers)) or not isfinite(parameter.typical):
        yield "bounds or preset are no numbers"
    elif not parameter.low <= parameter.typical <= parameter.high:
        yield f"the preset {parameter.typical:g} is not within {numbers[0]:g} … {numbers[2]:g}"
    elif parameter.low == parameter.high:
        yield "its bounds leave no choice"
    if parameter.per is not None and parameter.per not in {field.name for field in fields(Facts)}:
        yield f"per = {parameter.per!r} is no figure of an axis"
    strange = [word for word in _words(parameter.unit) if not _known(word)]
    if strange:
        yield f"unit {parameter.unit!r}: {', '.join(strange)} not known"


def _words(unit: str) -> list[str]:
    spaced = "".join(" " if sign in _SIGNS else sign for sign in unit)
    return spaced.split()


def _known(word: str) -> bool:
    return word in UNITS or (word[0] in _PREFIXES and word[1:] in UNITS)


def _twice(what: str, names: list[str]) -> Iterator[str]:
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"{what} {name!r} is there twice"
