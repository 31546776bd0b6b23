"""Hysteresis of a piezo: rising and falling paths differ at any speed.

The gain from end to end of the range stays 1, which separates hysteresis from a gain error. (It is
only approximately 1 if the loop is bent, or if ℓ is not short compared with the range.) A run
starts as after a first rise from the low end, where all operators are at rest.
"""

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
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_sizes

PLAY_COUNT = 10
DEAD_ZONE_COUNT = 8
# Substep of the integration, relative to the length ℓ over which the Bouc–Wen loop bends.
_SUBSTEP_RATIO = 0.1
_MAX_SUBSTEP_COUNT = 1000
# Steps shorter than this, relative to ℓ, use the midpoint rule: its error is below 1e-6 of ℓ.
_MAX_MIDPOINT_STEP_RATIO = 0.003


def apply_plays(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = w₀ x + Σ wᵢ Pᵢ(x)``, ``Pᵢ = max(x − rᵢ, min(x + rᵢ, Pᵢ))``, from the low end.

    p: x₀, w₀, then r and w of each play.
    """
    x -= p[0]
    y = p[1] * x
    for i in range(PLAY_COUNT):
        s[i] = max(x - p[2 + i], min(x + p[2 + i], s[i]))
        y += p[2 + PLAY_COUNT + i] * s[i]
    return p[0] + y


def apply_plays_and_dead_zones(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = v₀ z + v Σ max(z − dⱼ, 0)`` to z, the output of :func:`apply_plays`.

    p: as there, then v₀, v and the spacing of the dⱼ.
    """
    x -= p[0]
    z = p[1] * x
    for i in range(PLAY_COUNT):
        s[i] = max(x - p[2 + i], min(x + p[2 + i], s[i]))
        z += p[2 + PLAY_COUNT + i] * s[i]
    y = p[2 + 2 * PLAY_COUNT] * z
    for j in range(DEAD_ZONE_COUNT):
        y += p[3 + 2 * PLAY_COUNT] * max(z - p[4 + 2 * PLAY_COUNT] * j, 0.0)
    return p[0] + y


def apply_bouc_wen(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = k x − (W/2) ζ``, ``ℓ dζ = dx − |ζ|ⁿ (β |dx| sign ζ + (1 − β) dx)(1 + δ sign ζ)``.

    The equation is integrated along x by the classical Runge–Kutta rule, in steps that are short
    compared with ℓ. Very short steps use the midpoint rule, which is then equally accurate.

    p: x₀, k, W/2, ℓ, n, β, δ; s: ζ, x, from the low end.
    """
    x -= p[0]
    distance = (x - s[1]) / p[3]
    if distance != 0.0:
        substep_count = min(np.ceil(abs(distance) / _SUBSTEP_RATIO), _MAX_SUBSTEP_COUNT)
        step, direction = distance / substep_count, 1.0 if distance > 0.0 else -1.0
        remaining_count, zeta = substep_count, s[0]
        while remaining_count > 0.0:
            total, slope = 0.0, 0.0
            for k in range(4):
                stage_zeta = zeta + step * slope * (0.0 if k == 0 else (1.0 if k == 3 else 0.5))
                zeta_sign = 1.0 if stage_zeta > 0.0 else -1.0
                slope_reduction = abs(stage_zeta) ** p[4] * (
                    p[5] * zeta_sign * direction + 1.0 - p[5]
                )
                slope = 1.0 - slope_reduction * (1.0 + p[6] * zeta_sign)
                if k == 1 and abs(step) < _MAX_MIDPOINT_STEP_RATIO:
                    total = 6.0 * slope
                    break
                total += slope * (2.0 if k == 1 or k == 2 else 1.0)
            zeta += step * total / 6.0
            remaining_count -= 1.0
        s[0], s[1] = zeta, x
    return p[0] + p[1] * x - p[2] * s[0]


def _compute_even_thresholds() -> FloatArray:
    return 0.5 * (np.arange(PLAY_COUNT) + 0.5) / PLAY_COUNT


def _compute_fine_thresholds() -> FloatArray:
    """Return thresholds over the range that lie closer together at small values.

    A real hysteresis curve leaves its turning points steeply, and most of its loops are small.
    """
    return 0.5 * ((np.arange(PLAY_COUNT) + 0.5) / PLAY_COUNT) ** 2


def _compute_play_numbers(
    weights: FloatArray, thresholds: FloatArray, facts: AxisProperties
) -> tuple[float, ...]:
    """Return p of the plays, with w₀ such that the gain from end to end is 1.

    Over the range and back, a play of threshold r moves by 2 r less than its input.
    """
    direct_weight = 1.0 - float(np.sum(weights * (1.0 - 2.0 * thresholds)))
    return (facts.low, direct_weight, *(facts.span * thresholds), *weights)


def _compute_shaped_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p, with the weights scaled to the width of the loop.

    A loop from end to end is widest half way. Over a range S, a play of threshold r is
    ``min(2 r, S − 2 r)`` wide there. The weights, which grow as ``r^(shape − 1)``, are scaled so
    that ``width = Σ wᵢ min(2 rᵢ, S − 2 rᵢ)``.
    """
    thresholds = _compute_even_thresholds()
    weights = thresholds ** (values["shape"] - 1.0)
    widths = np.minimum(2.0 * thresholds, 1.0 - 2.0 * thresholds)
    weights *= values["width"] / facts.span / float(np.sum(weights * widths))
    return _compute_play_numbers(weights, thresholds, facts)


def _compute_ten_play_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    weights = np.array([values[f"weight_{i + 1}"] for i in range(PLAY_COUNT)])
    return _compute_play_numbers(weights, _compute_fine_thresholds(), facts)


def _compute_dead_zone_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p with the dead zones.

    The slope rises from ``1 − α/2`` at the low end to ``1 + α/2`` at the high end. The first dead
    zone starts at the low end and acts only above it.
    """
    spacing = 1.0 / DEAD_ZONE_COUNT
    slope = values["asymmetry"] / (DEAD_ZONE_COUNT - 1)
    added_gain = slope * float(np.sum(1.0 - spacing * np.arange(DEAD_ZONE_COUNT)))
    return (*_compute_shaped_numbers(values, facts), 1.0 - added_gain, slope, facts.span * spacing)


def _compute_bouc_wen_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
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


WIDTH = EffectParameter(
    "width", "width of the loop from end to end", "q", 0.0, 0.5, 0.1, per="span"
)
SHAPE = EffectParameter(
    "shape", "1: equal weights of all plays; more: larger weights of wide plays", "", 0.5, 4.0, 1.0
)
_TRAITS = frozenset({EffectTrait.RATE_INDEPENDENT, EffectTrait.DISSIPATIVE})

HYSTERESIS = Effect(
    id="hysteresis",
    title="Hysteresis",
    summary="Loops whose width grows faster than their amplitude, at any speed; odd distortion.",
    stage=EffectStage.ACTUATOR,
    kinds=frozenset({"piezo"}),
    identification=IdentificationHints(starts=start_from_sizes(width=(0.3, 1.0))),
    kinship=EffectRelations(
        family=EffectFamily.LOOP,
        brings_along={EffectFamily.GAIN: 1.0, EffectFamily.CURVE: 0.1},
        accompanied_by=EffectFamily.CREEP,
        narrow=frozenset({"bouc_wen"}),
    ),
    formulations=(
        Formulation(
            name="prandtl_ishlinskii",
            equation="y = w₀ x + Σ wᵢ Pᵢ(x), Pᵢ = max(x − rᵢ, min(x + rᵢ, Pᵢ)), i = 1…10",
            source="Kuhnen, European Journal of Control 9 (2003) 407–418",
            parameters=(WIDTH, SHAPE),
            acts=InputFunction(step=apply_plays, states=PLAY_COUNT),
            prepare=_compute_shaped_numbers,
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
                EffectParameter(
                    "asymmetry", "growth of the slope from end to end", "", -1.0, 1.0, 0.2
                ),
            ),
            acts=InputFunction(step=apply_plays_and_dead_zones, states=PLAY_COUNT),
            prepare=_compute_dead_zone_numbers,
            traits=_TRAITS,
        ),
        Formulation(
            name="bouc_wen",
            equation="y = k x − (W/2) ζ, "
            "ℓ dζ = dx − |ζ|ⁿ (β |dx| sign ζ + (1 − β) dx)(1 + δ sign ζ)",
            source="Song and Der Kiureghian, Journal of Engineering Mechanics 132 (2006) 610–618",
            parameters=(
                EffectParameter(
                    "width",
                    "W, width of a loop that is long compared with ℓ",
                    "q",
                    0.0,
                    0.5,
                    0.1,
                    per="span",
                ),
                EffectParameter(
                    "reach", "ℓ, length over which the loop bends", "q", 0.03, 2.0, 0.25, per="span"
                ),
                EffectParameter("sharpness", "n", "", 1.0, 6.0, 1.0),
                EffectParameter(
                    "winding", "β; 1/2: straight line after a reversal", "", 0.5, 1.5, 1.0
                ),
                EffectParameter(
                    "asymmetry", "δ, asymmetry of the way up and the way down", "", -0.8, 0.8, 0.1
                ),
            ),
            acts=InputFunction(step=apply_bouc_wen, states=2),
            prepare=_compute_bouc_wen_numbers,
            traits=_TRAITS,
        ),
        Formulation(
            name="ten_plays",
            equation="y = w₀ x + Σ wᵢ Pᵢ(x), every wᵢ by itself, rᵢ = ((i − ½)/10)²/2 of the range",
            source="Kuhnen, European Journal of Control 9 (2003) 407–418",
            parameters=tuple(
                EffectParameter(
                    f"weight_{i}",
                    f"w{i}, weight of the play with threshold {((i - 0.5) / 10) ** 2 / 2:g}",
                    "",
                    0.0,
                    2.0,
                    0.04,
                )
                for i in range(1, PLAY_COUNT + 1)
            ),
            acts=InputFunction(step=apply_plays, states=PLAY_COUNT),
            prepare=_compute_ten_play_numbers,
            traits=_TRAITS,
        ),
    ),
)
