"""Saturation: the output ends before the range of the input."""

from collections.abc import Iterator, Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification, View
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.soft_ends import bent_ends
from rotemina.sim.records.record import Tap


def hard(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = max(L, min(H, x))``. p: L, H."""
    return max(p[0], min(p[1], x))


def soft(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = c + A v (1 + |v|ⁿ)^(−1/n)``, v = (x − c)/A, 1/n the softness; hard where that is 0.

    p: L, H, 1/n, with c the middle and A half the length of L…H.
    """
    if p[2] <= 0.0:
        return max(p[0], min(p[1], x))
    middle, half = 0.5 * (p[0] + p[1]), 0.5 * (p[1] - p[0])
    v = (x - middle) / half
    size = abs(v)
    if size <= 1.0:
        return middle + half * v * np.exp(-p[2] * np.log1p(size ** (1.0 / p[2])))
    end = half * np.exp(-p[2] * np.log1p(size ** (-1.0 / p[2])))
    return middle + end if v > 0.0 else middle - end


def _ends(values: Values, facts: Facts) -> tuple[float, ...]:
    return (
        facts.input_low + values["low_margin"],
        facts.input_high - values["high_margin"],
        values.get("softness", 0.0),
    )


def _margin(name: str, end: str) -> Parameter:
    meaning = f"distance of the output's limit from the {end} end of the input range"
    return Parameter(name, meaning, "u", -0.5, 0.45, 0.05, per="input_span")


_MARGINS = (_margin("low_margin", "low"), _margin("high_margin", "high"))
_TRAITS = frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT})

_BEYOND = (0.04, 0.15)  # of the way, which a saturated amplifier does not go
_SOFT_ENDS = (0.0, 0.1)  # of the way that was seen, that a soft end lies beyond it
_RARELY = 0.002  # of the rows


def _margins(view: View) -> Iterator[Values]:
    """Return limits of an amplifier, a little inside the requested range."""
    facts, soft = view.facts, "softness" in view.values
    seen = [one.real[Tap.U] for one in view.records if Tap.U in one.real]
    if seen:
        yield from _ends_seen(view, seen)
    if facts.kind == "force":  # whose commands ask for no voltage
        if not seen:
            yield {}
        return
    gain = facts.gain if facts.kind == "piezo" else 1.0
    went = _way(view) / gain
    for beyond in _SOFT_ENDS if soft else (0.0,):
        further = beyond * float(np.ptp(went))
        yield _between(facts, went[0] - further, went[1] + further)
    least, most = (end / gain for end in view.extent.reach)
    low, high = least - facts.input_low, facts.input_high - most
    for share in _BEYOND:
        beyond = share * (most - least)
        yield {"low_margin": low + beyond, "high_margin": high + beyond}
        yield {"low_margin": low - beyond, "high_margin": high + beyond}
        yield {"low_margin": low + beyond, "high_margin": high - beyond}


def _ends_seen(view: View, seen: Sequence[FloatArray]) -> Iterator[Values]:
    """Give the ends of the voltages (n,) that were seen: what saturates goes no further."""
    facts = view.facts
    ends = min(float(u.min()) for u in seen), max(float(u.max()) for u in seen)
    yield _between(facts, *ends)
    if facts.kind == "piezo" and "softness" in view.values:
        # An end that these voltages do not come near may as well lie beyond the range.
        asked = [
            answer[Tap.U]
            for record, answer in zip(view.records, view.answers, strict=True)
            if Tap.U in record.real
        ]
        bend = bent_ends(np.concatenate(asked), np.concatenate(seen), ends)
        for one in (
            bend,
            bend.without_low(facts.input_low),
            bend.without_high(facts.input_high),
        ):
            yield {**_between(facts, one.low, one.high), "softness": one.softness}


def _between(facts: Facts, low: float, high: float) -> dict[str, float]:
    return {"low_margin": low - facts.input_low, "high_margin": facts.input_high - high}


def _way(view: View) -> FloatArray:
    """Return where (2,) the axis was at least and at most, m or rad, but for outliers."""
    seen = [
        next(signal for tap, signal in one.real.items() if tap is not Tap.U)
        for one in view.records
        if set(one.real) - {Tap.U}
    ]
    if not seen:
        return np.asarray(view.extent.reach)
    return np.asarray(np.quantile(np.concatenate(seen), (_RARELY, 1.0 - _RARELY)))


SATURATION = Effect(
    id="saturation",
    title="Saturation",
    summary="The output cannot reach the command, only near the ends of the range.",
    stage=Stage.ELECTRONICS,
    kinds=frozenset({"piezo", "force"}),
    identification=Identification(starts=_margins),
    kinship=Kinship(family=Family.LIMIT),
    formulations=(
        Formulation(
            name="hard",
            equation="y = max(L, min(H, x)), L and H by a margin inside the input's range",
            source="Hu and Lin, Control Systems with Actuator Saturation (2001), ch. 1",
            parameters=_MARGINS,
            acts=Drive(step=hard),
            prepare=_ends,
            traits=_TRAITS,
        ),
        Formulation(
            name="soft",
            equation="y = c + A v (1 + |v|ⁿ)^(−1/n), v = (x − c)/A, c ± A = L, H",
            source="Rapp, 2nd European Conference on Satellite Communications (1991) 179–184",
            parameters=(
                *_MARGINS,
                Parameter("softness", "1/n; 0: hard", "", 0.0, 0.5, 0.08),
            ),
            acts=Drive(step=soft),
            prepare=_ends,
            traits=_TRAITS,
        ),
    ),
)
