"""Saturation: the output ends before the range of its input does."""

import numpy as np

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
    meaning = f"how far inside the {end} end of the input's range the output ends"
    return Parameter(name, meaning, "u", -0.5, 0.45, 0.05, per="input_span")


_MARGINS = (_margin("low_margin", "low"), _margin("high_margin", "high"))
_TRAITS = frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT})

SATURATION = Effect(
    id="saturation",
    title="Saturation",
    summary="The output cannot reach the command, only near the ends of the range.",
    stage=Stage.ELECTRONICS,
    kinds=frozenset({"piezo", "force"}),
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
                Parameter("softness", "1/n; 0 is the hard one", "", 0.0, 0.5, 0.08),
            ),
            acts=Drive(step=soft),
            prepare=_ends,
            traits=_TRAITS,
        ),
    ),
)
