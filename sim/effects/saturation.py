"""Saturation: the output is limited to less than the range of the input."""

from collections.abc import Iterator, Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
    Values,
)
from rotemina.sim.effects.identification import FitView, IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.soft_ends import fit_limits
from rotemina.sim.records import Tap


def apply_hard_limits(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = max(L, min(H, x))``. p: L, H."""
    return max(p[0], min(p[1], x))


def apply_soft_limits(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = c + A v (1 + |v|ⁿ)^(−1/n)``, v = (x − c)/A, 1/n the softness; hard if that is 0.

    p: L, H, 1/n, with c the middle and A half the length of L…H.
    """
    if p[2] <= 0.0:
        return max(p[0], min(p[1], x))
    middle, half_range = 0.5 * (p[0] + p[1]), 0.5 * (p[1] - p[0])
    v = (x - middle) / half_range
    magnitude = abs(v)
    if magnitude <= 1.0:
        return middle + half_range * v * np.exp(-p[2] * np.log1p(magnitude ** (1.0 / p[2])))
    distance = half_range * np.exp(-p[2] * np.log1p(magnitude ** (-1.0 / p[2])))
    return middle + distance if v > 0.0 else middle - distance


def _compute_limits(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    return (
        facts.input_low + values["low_margin"],
        facts.input_high - values["high_margin"],
        values.get("softness", 0.0),
    )


def _make_margin(name: str, end: str) -> EffectParameter:
    meaning = f"distance of the output's limit from the {end} end of the input range"
    return EffectParameter(name, meaning, "u", -0.5, 0.45, 0.05, per="input_span")


_MARGIN_PARAMETERS = (_make_margin("low_margin", "low"), _make_margin("high_margin", "high"))
_TRAITS = frozenset({EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT})

# Parts of the travel that saturation may cut off.
_MISSING_TRAVEL_RATIOS = (0.04, 0.15)
# Distances of a soft limit from the end of the observed travel, relative to the travel.
_SOFT_MARGIN_RATIOS = (0.0, 0.1)
# Share of the rows that may be outliers.
_OUTLIER_RATIO = 0.002


def _start_from_margins(view: FitView) -> Iterator[Values]:
    facts, is_soft = view.facts, "softness" in view.values
    voltages = [record.real[Tap.U] for record in view.records if Tap.U in record.real]
    if voltages:
        yield from _start_from_voltages(view, voltages)
    # The commands of a force axis request no voltage.
    if facts.kind == "force":
        if not voltages:
            yield {}
        return
    gain = facts.gain if facts.kind == "piezo" else 1.0
    travel = _find_travel(view) / gain
    for ratio in _SOFT_MARGIN_RATIOS if is_soft else (0.0,):
        margin = ratio * float(np.ptp(travel))
        yield _make_margins(facts, travel[0] - margin, travel[1] + margin)
    lowest, highest = (end / gain for end in view.extent.reach)
    low, high = lowest - facts.input_low, facts.input_high - highest
    for ratio in _MISSING_TRAVEL_RATIOS:
        missing_travel = ratio * (highest - lowest)
        yield {"low_margin": low + missing_travel, "high_margin": high + missing_travel}
        yield {"low_margin": low - missing_travel, "high_margin": high + missing_travel}
        yield {"low_margin": low + missing_travel, "high_margin": high - missing_travel}


def _start_from_voltages(view: FitView, voltages: Sequence[FloatArray]) -> Iterator[Values]:
    """Yield limits at the ends of the measured voltages (n,), where a saturated output stops."""
    facts = view.facts
    ends = min(float(u.min()) for u in voltages), max(float(u.max()) for u in voltages)
    yield _make_margins(facts, *ends)
    if facts.kind == "piezo" and "softness" in view.values:
        # If the voltages do not come near a limit, it may also lie outside the range.
        requested_voltages = [
            response[Tap.U]
            for record, response in zip(view.records, view.answers, strict=True)
            if Tap.U in record.real
        ]
        limits = fit_limits(np.concatenate(requested_voltages), np.concatenate(voltages), ends)
        for variant in (
            limits,
            limits.without_low(facts.input_low),
            limits.without_high(facts.input_high),
        ):
            yield {**_make_margins(facts, variant.low, variant.high), "softness": variant.softness}


def _make_margins(facts: AxisProperties, low: float, high: float) -> dict[str, float]:
    return {"low_margin": low - facts.input_low, "high_margin": facts.input_high - high}


def _find_travel(view: FitView) -> FloatArray:
    """Return the smallest and largest position (2,) of the axis, m or rad, without outliers."""
    positions = [
        next(signal for tap, signal in record.real.items() if tap is not Tap.U)
        for record in view.records
        if set(record.real) - {Tap.U}
    ]
    if not positions:
        return np.asarray(view.extent.reach)
    return np.asarray(
        np.quantile(np.concatenate(positions), (_OUTLIER_RATIO, 1.0 - _OUTLIER_RATIO))
    )


SATURATION = Effect(
    id="saturation",
    title="Saturation",
    summary="The output cannot reach the command, only near the ends of the range.",
    stage=EffectStage.ELECTRONICS,
    kinds=frozenset({"piezo", "force"}),
    identification=IdentificationHints(starts=_start_from_margins),
    kinship=EffectRelations(family=EffectFamily.LIMIT),
    formulations=(
        Formulation(
            name="hard",
            equation="y = max(L, min(H, x)), L and H by a margin inside the input's range",
            source="Hu and Lin, Control Systems with Actuator Saturation (2001), ch. 1",
            parameters=_MARGIN_PARAMETERS,
            acts=InputFunction(step=apply_hard_limits),
            prepare=_compute_limits,
            traits=_TRAITS,
        ),
        Formulation(
            name="soft",
            equation="y = c + A v (1 + |v|ⁿ)^(−1/n), v = (x − c)/A, c ± A = L, H",
            source="Rapp, 2nd European Conference on Satellite Communications (1991) 179–184",
            parameters=(
                *_MARGIN_PARAMETERS,
                EffectParameter("softness", "1/n; 0: hard", "", 0.0, 0.5, 0.08),
            ),
            acts=InputFunction(step=apply_soft_limits),
            prepare=_compute_limits,
            traits=_TRAITS,
        ),
    ),
)
