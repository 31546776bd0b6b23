"""Checks of the description of an effect."""

from collections.abc import Iterator
from dataclasses import fields
from math import isfinite, isnan

from rotemina.sim.effects import (
    EVERY_KIND,
    RESERVED_KEYS,
    AxisProperties,
    Effect,
    EffectParameter,
    EffectStage,
    Formulation,
)
from rotemina.sim.errors import EffectError
from rotemina.sim.simulation.check_bench import EffectBench
from rotemina.sim.simulation.check_result import CheckResult, check_no_faults

#: Symbols that a unit may contain; q, u and N stand for the units of the axis.
UNIT_SYMBOLS = frozenset(
    ("q", "u", "N", "m", "rad", "s", "Hz", "V", "A", "K", "W", "J", "F", "C", "Ω", "ppm", "dB")
)
_UNIT_PREFIXES = "pnµmkMG"
_UNIT_SIGNS = set(" …/·*√^²³⁻¹()0123456789.-%")


def check_catalogue(effect: Effect) -> Iterator[CheckResult]:
    """Check the description of an effect and of its formulations."""
    yield check_no_faults("effect description is complete", list(_find_effect_faults(effect)))
    for formulation in effect.formulations:
        result = check_no_faults(
            "formulation description is complete", list(_find_formulation_faults(formulation))
        )
        yield CheckResult(
            result.name, result.passed, result.value, result.bound, result.note, formulation.name
        )


def check_bounds(bench: EffectBench) -> CheckResult:
    """Check that the presets are accepted, and that values beyond a bound are refused."""
    faults = []
    try:
        bench.attach()
    except EffectError as error:
        faults.append(f"its presets are refused: {error}")
    for parameter in bench.formulation.parameters:
        low, high = parameter.bounds(bench.facts)
        margin = 1e-3 * max(abs(low) if isfinite(low) else 0.0, abs(high) if isfinite(high) else 0)
        values_beyond = [
            end for end in (low - (margin or 1.0), high + (margin or 1.0)) if isfinite(end)
        ]
        for value in [*values_beyond, float("nan")]:
            try:
                bench.attach({parameter.name: value})
            except EffectError:
                continue
            faults.append(f"{parameter.name} = {value:g} is not refused")
    return check_no_faults("values beyond bounds are refused", faults)


def _find_effect_faults(effect: Effect) -> Iterator[str]:
    for name in ("id", "title", "summary"):
        if not str(getattr(effect, name)).strip():
            yield f"its {name} is empty"
    if not effect.id.replace("_", "").isalnum() or effect.id != effect.id.lower():
        yield f"its id {effect.id!r} must consist of lower-case letters, digits and _"
    if not isinstance(effect.stage, EffectStage):
        yield f"its stage {effect.stage!r} must be one of {', '.join(EffectStage)}"
    if not effect.kinds or not effect.kinds <= EVERY_KIND:
        yield f"its kinds {sorted(effect.kinds)} are not among {sorted(EVERY_KIND)}"
    names = [formulation.name for formulation in effect.formulations]
    if not names:
        yield "it has no formulation"
    yield from _find_duplicates("formulation", names)


def _find_formulation_faults(formulation: Formulation) -> Iterator[str]:
    for name in ("name", "equation", "source"):
        if not str(getattr(formulation, name)).strip():
            yield f"its {name} is empty"
    if not formulation.parameters:
        yield "it has no parameter"
    yield from _find_duplicates(
        "parameter", [parameter.name for parameter in formulation.parameters]
    )
    for parameter in formulation.parameters:
        for fault in _find_parameter_faults(parameter):
            yield f"{parameter.name}: {fault}"


def _find_parameter_faults(parameter: EffectParameter) -> Iterator[str]:
    if not parameter.name.isidentifier() or parameter.name in RESERVED_KEYS:
        yield "is not a valid parameter name"
    if not parameter.meaning.strip():
        yield "its meaning is empty"
    numbers = (parameter.low, parameter.typical, parameter.high)
    if any(map(isnan, numbers)) or not isfinite(parameter.typical):
        yield "its bounds or its preset are not numbers"
    elif not parameter.low <= parameter.typical <= parameter.high:
        yield f"its preset {parameter.typical:g} is not within {numbers[0]:g} … {numbers[2]:g}"
    elif parameter.low == parameter.high:
        yield "its bounds are equal"
    if parameter.per is not None and parameter.per not in {
        field.name for field in fields(AxisProperties)
    }:
        yield f"per = {parameter.per!r} is not a property of an axis"
    unknown_words = [word for word in _split_unit(parameter.unit) if not _is_known_unit(word)]
    if unknown_words:
        yield f"unit {parameter.unit!r}: {', '.join(unknown_words)} unknown"


def _split_unit(unit: str) -> list[str]:
    spaced_words = "".join(" " if character in _UNIT_SIGNS else character for character in unit)
    return spaced_words.split()


def _is_known_unit(word: str) -> bool:
    return word in UNIT_SYMBOLS or (word[0] in _UNIT_PREFIXES and word[1:] in UNIT_SYMBOLS)


def _find_duplicates(kind: str, names: list[str]) -> Iterator[str]:
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"{kind} {name!r} occurs twice"
