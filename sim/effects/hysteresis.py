"""Hysteresis of a piezo: rising and falling paths differ at any speed.

The gain from end to end of the range stays 1 (approximately if the loop is bent, or ℓ is not short
compared with the range), which separates hysteresis from a gain error. A run starts as after a
first rise from the low end, where all operators are at rest.
"""

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
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import sizes

PLAYS = 10
DEAD_ZONES = 8
_SUBSTEP = 0.1  # of the length over which the Bouc–Wen loop bends
_MOST_SUBSTEPS = 1000
_SHORT = 0.003  # of that length: steps of which the midpoint rule leaves less than 1e-6 of it


def play_operators(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = w₀ x + Σ wᵢ Pᵢ(x)``; play ``Pᵢ = max(x − rᵢ, min(x + rᵢ, Pᵢ))``, from the low end.

    p: x₀, w₀, then r and w of each play.
    """
    x -= p[0]
    y = p[1] * x
    for i in range(PLAYS):
        s[i] = max(x - p[2 + i], min(x + p[2 + i], s[i]))
        y += p[2 + PLAYS + i] * s[i]
    return p[0] + y


def plays_and_dead_zones(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = v₀ z + v Σ max(z − dⱼ, 0)`` of z, the sum of :func:`play_operators`.

    p: as there, then v₀, v and the spacing of the dⱼ.
    """
    x -= p[0]
    z = p[1] * x
    for i in range(PLAYS):
        s[i] = max(x - p[2 + i], min(x + p[2 + i], s[i]))
        z += p[2 + PLAYS + i] * s[i]
    y = p[2 + 2 * PLAYS] * z
    for j in range(DEAD_ZONES):
        y += p[3 + 2 * PLAYS] * max(z - p[4 + 2 * PLAYS] * j, 0.0)
    return p[0] + y


def bouc_wen(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = k x − (W/2) ζ``, ``ℓ dζ = dx − |ζ|ⁿ (β |dx| sign ζ + (1 − β) dx)(1 + δ sign ζ)``.

    Integrated along x by the classical Runge–Kutta rule in steps that are short compared with ℓ; by
    the midpoint rule, equally accurate, if they are very short.

    p: x₀, k, W/2, ℓ, n, β, δ; s: ζ, x, from the low end.
    """
    x -= p[0]
    way = (x - s[1]) / p[3]
    if way != 0.0:
        count = min(np.ceil(abs(way) / _SUBSTEP), _MOST_SUBSTEPS)
        step, up = way / count, 1.0 if way > 0.0 else -1.0
        left, zeta = count, s[0]
        while left > 0.0:
            total, slope = 0.0, 0.0
            for k in range(4):
                at = zeta + step * slope * (0.0 if k == 0 else (1.0 if k == 3 else 0.5))
                side = 1.0 if at > 0.0 else -1.0
                pull = abs(at) ** p[4] * (p[5] * side * up + 1.0 - p[5])
                slope = 1.0 - pull * (1.0 + p[6] * side)
                if k == 1 and abs(step) < _SHORT:
                    total = 6.0 * slope
                    break
                total += slope * (2.0 if k == 1 or k == 2 else 1.0)
            zeta += step * total / 6.0
            left -= 1.0
        s[0], s[1] = zeta, x
    return p[0] + p[1] * x - p[2] * s[0]


def _thresholds() -> FloatArray:
    """Return the plays' thresholds over the range: evenly up to half of it."""
    return 0.5 * (np.arange(PLAYS) + 0.5) / PLAYS


def _fine_thresholds() -> FloatArray:
    """Return thresholds over the range that lie closer where they are small.

    A real loop leaves its turning points steeply, and most of its loops are small ones.
    """
    return 0.5 * ((np.arange(PLAYS) + 0.5) / PLAYS) ** 2


def _played(weights: FloatArray, thresholds: FloatArray, facts: Facts) -> tuple[float, ...]:
    """Return the numbers of plays; w₀ such that the gain from end to end is 1.

    There and back a play of threshold r moves by 2 r less than its input.
    """
    direct = 1.0 - float(np.sum(weights * (1.0 - 2.0 * thresholds)))
    return (facts.low, direct, *(facts.span * thresholds), *weights)


def _spread(values: Values, facts: Facts) -> tuple[float, ...]:
    """Shape the weights to the asked width.

    A loop from end to end is widest where it is half way. Over a range S, a play of threshold r is
    ``min(2 r, S − 2 r)`` wide there, so the weights, growing as ``r^(shape − 1)``, are scaled for
    ``width = Σ wᵢ min(2 rᵢ, S − 2 rᵢ)``.
    """
    thresholds = _thresholds()
    weights = thresholds ** (values["shape"] - 1.0)
    widths = np.minimum(2.0 * thresholds, 1.0 - 2.0 * thresholds)
    weights *= values["width"] / facts.span / float(np.sum(weights * widths))
    return _played(weights, thresholds, facts)


def _single(values: Values, facts: Facts) -> tuple[float, ...]:
    weights = np.array([values[f"weight_{i + 1}"] for i in range(PLAYS)])
    return _played(weights, _fine_thresholds(), facts)


def _bent(values: Values, facts: Facts) -> tuple[float, ...]:
    """Add the dead zones: slopes from ``1 − α/2`` at the low end to ``1 + α/2`` at the high one.

    The first dead zone starts at the low end and acts only above it.
    """
    spacing = 1.0 / DEAD_ZONES
    more = values["asymmetry"] / (DEAD_ZONES - 1)
    gained = more * float(np.sum(1.0 - spacing * np.arange(DEAD_ZONES)))
    return (*_spread(values, facts), 1.0 - gained, more, facts.span * spacing)


def _wound(values: Values, facts: Facts) -> tuple[float, ...]:
    width = values["width"]
    gain = 1.0 + width / facts.span
    return (
        facts.low,
        gain,
        0.5 * width,
        values["reach"],
        values["sharpness"],
        values["winding"],
        values["asymmetry"],
    )


WIDTH = Parameter("width", "width of the loop from end to end", "q", 0.0, 0.5, 0.1, per="span")
SHAPE = Parameter(
    "shape", "1: equal weights of all plays; more: larger weights of wide plays", "", 0.5, 4.0, 1.0
)
_TRAITS = frozenset({Trait.RATE_INDEPENDENT, Trait.DISSIPATIVE})

HYSTERESIS = Effect(
    id="hysteresis",
    title="Hysteresis",
    summary="Loops whose width grows faster than their amplitude, at any speed; odd distortion.",
    stage=Stage.ACTUATOR,
    kinds=frozenset({"piezo"}),
    identification=Identification(starts=sizes(width=(0.3, 1.0))),
    kinship=Kinship(
        family=Family.LOOP,
        brings_along={Family.GAIN: 1.0, Family.CURVE: 0.1},
        accompanied_by=Family.CREEP,
        narrow=frozenset({"bouc_wen"}),
    ),
    formulations=(
        Formulation(
            name="prandtl_ishlinskii",
            equation="y = w₀ x + Σ wᵢ Pᵢ(x), Pᵢ = max(x − rᵢ, min(x + rᵢ, Pᵢ)), i = 1…10",
            source="Kuhnen, European Journal of Control 9 (2003) 407–418",
            parameters=(WIDTH, SHAPE),
            acts=Drive(step=play_operators, states=PLAYS),
            prepare=_spread,
            traits=_TRAITS,
        ),
        Formulation(
            name="modified_prandtl_ishlinskii",
            equation="y = v₀ z + v Σ max(z − dⱼ, 0), j = 0…7; z = w₀ x + Σ wᵢ Pᵢ(x)",
            source="Kuhnen, European Journal of Control 9 (2003) 407–418: one-sided dead zones "
            "behind the plays",
            parameters=(
                WIDTH,
                SHAPE,
                Parameter("asymmetry", "growth of the slope from end to end", "", -1.0, 1.0, 0.2),
            ),
            acts=Drive(step=plays_and_dead_zones, states=PLAYS),
            prepare=_bent,
            traits=_TRAITS,
        ),
        Formulation(
            name="bouc_wen",
            equation="y = k x − (W/2) ζ, "
            "ℓ dζ = dx − |ζ|ⁿ (β |dx| sign ζ + (1 − β) dx)(1 + δ sign ζ)",
            source="Song and Der Kiureghian, Journal of Engineering Mechanics 132 (2006) 610–618",
            parameters=(
                Parameter(
                    "width",
                    "W, width of a loop that is long compared with ℓ",
                    "q",
                    0.0,
                    0.5,
                    0.1,
                    per="span",
                ),
                Parameter(
                    "reach", "ℓ, length over which the loop bends", "q", 0.03, 2.0, 0.25, per="span"
                ),
                Parameter("sharpness", "n", "", 1.0, 6.0, 1.0),
                Parameter("winding", "β; 1/2: straight line after a reversal", "", 0.5, 1.5, 1.0),
                Parameter(
                    "asymmetry", "δ, asymmetry of the way up and the way down", "", -0.8, 0.8, 0.1
                ),
            ),
            acts=Drive(step=bouc_wen, states=2),
            prepare=_wound,
            traits=_TRAITS,
        ),
        Formulation(
            name="ten_plays",
            equation="y = w₀ x + Σ wᵢ Pᵢ(x), every wᵢ by itself, rᵢ = ((i − ½)/10)²/2 of the range",
            source="Kuhnen, European Journal of Control 9 (2003) 407–418",
            parameters=tuple(
                Parameter(
                    f"weight_{i}",
                    f"w{i}, weight of the play with threshold {((i - 0.5) / 10) ** 2 / 2:g}",
                    "",
                    0.0,
                    2.0,
                    0.04,
                )
                for i in range(1, PLAYS + 1)
            ),
            acts=Drive(step=play_operators, states=PLAYS),
            prepare=_single,
            traits=_TRAITS,
        ),
    ),
)
