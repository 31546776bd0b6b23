"""One-sided contact with a stop, a dish or a cell membrane. It acts only beyond a position.

The sign of the strength gives the side: positive for an obstacle met on the way up, negative for
one met on the way down. A fit therefore passes smoothly through "no contact" from one to the other.
"""

from collections.abc import Iterator
from math import inf, pi, sqrt

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    ForceFunction,
    Formulation,
    PositionFunction,
    Values,
)
from rotemina.sim.effects.identification import (
    FitView,
    IdentificationHints,
    Interval,
    RecordCoverage,
)
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations

# Inner step in periods of the axis in contact.
_INNER_STEP_PERIODS = 1.0 / 30.0
# Depth, relative to the range, at which a progressive contact has its nominal stiffness.
_NOMINAL_DEPTH_RATIO = 0.1


def compute_spring_force(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the force of a spring and damper that the axis touches at a position.

    The work of the force over the step equals the change of the spring's energy. With the depth δ₀
    before the step, and the depth after it, δ₁, reduced by the force N itself to ``δ₁ − a N``:
    ``N (δ₁ − a N − δ₀) = k/2 (⟨δ₁ − a N⟩² − ⟨δ₀⟩²)``, ``⟨δ⟩ = max(δ, 0)``. This is at most a
    quadratic equation, at any stiffness. The damper acts for the fraction of the step during which
    the axis is in contact. The force never pulls.

    p: side, place, k, c.
    """
    mid_depth = p[0] * (x - p[1])
    half_travel = 0.5 * h * p[0] * other
    depth_before, depth_after = mid_depth - half_travel, mid_depth + half_travel
    contact_fraction = 1.0
    if depth_before > 0.0:
        force = p[2] * mid_depth + p[3] * p[0] * other
        force = max(force / (1.0 + 0.5 * p[2] * a + p[3] * b), 0.0)
        # The axis stays in contact for the whole step.
        if depth_after - a * force > 0.0:
            return -p[0] * force
        # The axis leaves the contact during the step.
        root = np.sqrt(half_travel * half_travel + 0.5 * p[2] * a * depth_before * depth_before)
        force = 0.5 * p[2] * depth_before * depth_before / (root - half_travel)
        contact_fraction = depth_before / (depth_before - depth_after + a * force)
    elif depth_after > 0.0:
        # The axis comes into contact during the step.
        linear = 2.0 * half_travel + p[2] * a * depth_after
        root = np.sqrt(
            4.0 * half_travel * half_travel - 2.0 * p[2] * a * depth_after * depth_before
        )
        force = p[2] * depth_after * depth_after / (linear + root)
        remaining_depth = depth_after - a * force
        contact_fraction = remaining_depth / (remaining_depth - depth_before)
    else:
        return 0.0
    damping = contact_fraction * p[3]
    force = (force + damping * p[0] * other) / (1.0 + damping * b)
    return -p[0] * max(force, 0.0)


def compute_progressive_force(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the force ``N = k D (δ/D)ⁿ`` and that of a damper.

    δ is the depth at mid-step, which the force reduces by ``a N/2``. Newton's method from N = 0
    stays below the root, because the right side is convex.

    p: side, place, k, c, n, D.
    """
    depth = p[0] * (x - p[1])
    if depth <= 0.0:
        return 0.0
    force = 0.0
    for _ in range(3):
        reduced_depth = depth - 0.5 * a * force
        spring_force = p[2] * p[5] * (reduced_depth / p[5]) ** p[4]
        force -= (force - spring_force) / (1.0 + 0.5 * a * p[4] * spring_force / reduced_depth)
    half_travel = 0.5 * h * abs(other)
    # Fade the damper in with the depth, so that a mere touch causes no jump of the force.
    damping = p[3] if depth >= half_travel else p[3] * depth / half_travel
    force = (force + damping * p[0] * other) / (1.0 + damping * b)
    return -p[0] * max(force, 0.0)


def block_motion(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Block a share of the motion beyond a place. p: side, place, blocked share."""
    return x - p[2] * p[0] * max(p[0] * (x - p[1]), 0.0)


def _find_side(strength: float) -> float:
    return -1.0 if strength < 0.0 else 1.0


def _compute_stiffness(values: Values, facts: AxisProperties) -> float:
    """Return the stiffness of the contact.

    On a free axis it is relative to the force of the axis over its range.
    """
    axis_stiffness = facts.stiffness if facts.stiffness > 0.0 else facts.force / facts.span
    return abs(values["stiffness"]) * axis_stiffness


def _compute_spring_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p; the damping is ``c = 2ζ k/ω`` at the natural frequency of the axis alone."""
    stiffness = _compute_stiffness(values, facts)
    damping = stiffness * values["damping_ratio"] / (pi * facts.pace_hz)
    return (_find_side(values["stiffness"]), facts.low + values["place"], stiffness, damping)


def _compute_progressive_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    return (
        *_compute_spring_numbers(values, facts),
        values["exponent"],
        _NOMINAL_DEPTH_RATIO * facts.span,
    )


def _compute_stop_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    return (_find_side(values["blocked"]), facts.low + values["place"], abs(values["blocked"]))


def _compute_inner_step(values: Values, facts: AxisProperties) -> float:
    stiffness = facts.stiffness + _compute_stiffness(values, facts) * values.get("exponent", 1.0)
    return _INNER_STEP_PERIODS * 2.0 * pi * sqrt(facts.mass / stiffness) if stiffness > 0.0 else inf


_PLACE = EffectParameter(
    "place",
    "position of the contact, from the low end of the range",
    "q",
    0.01,
    0.99,
    0.7,
    per="span",
)
_STIFFNESS = EffectParameter(
    "stiffness",
    "relative to the axis' own stiffness; negative: met on the way down",
    "",
    -30.0,
    30.0,
    0.5,
)
_DAMPING = EffectParameter("damping_ratio", "ζ, damping ratio of the contact", "", 0.0, 2.0, 0.1)
_DISSIPATIVE = frozenset({EffectTrait.MEMORYLESS, EffectTrait.DISSIPATIVE})

# Positions at which a fit first looks for a contact, relative to the travel towards it.
_START_PLACE_RATIOS = (0.4, 0.6, 0.8, 0.92)
# Distances between a fitted stop and the start of a soft contact before it, relative to the travel.
_START_LEAD_RATIOS = (0.0, 0.03, 0.08)
_STIFFNESS_FACTORS = (1.0, 3.0)
# A larger blocked share is reduced to this, so that the equivalent stiffness stays finite.
_MAX_BLOCKED_SHARE = 0.96
# Largest share of the travel over which a contact may act.
_MAX_CONTACT_TRAVEL_RATIO = 0.7


def _start_from_places(view: FitView) -> Iterator[Values]:
    values, (lowest, highest) = view.values, view.extent.reach
    low, high = view.bounds("place")
    strength = next(name for name in ("stiffness", "blocked") if name in values)
    # A stop was fitted: a soft contact begins near it or a little before it.
    if view.starts_from_other_fit:
        place, fitted_strength = values["place"], values[strength]
        for lead in _START_LEAD_RATIOS:
            earlier_place = place - float(np.sign(fitted_strength)) * lead * (highest - lowest)
            for factor in _STIFFNESS_FACTORS:
                yield {"place": earlier_place, strength: fitted_strength * factor}
        return
    for sign in (1.0, -1.0):
        for ratio in _START_PLACE_RATIOS:
            place = lowest if sign < 0.0 else highest
            place -= sign * (1.0 - ratio) * (highest - lowest)
            yield {
                "place": float(np.clip(place - view.facts.low, low, high)),
                strength: sign * abs(values[strength]),
            }


def _convert_stop(fitted: Values) -> Values:
    """Convert a fitted stop, which blocks a share of the motion, to a spring.

    A spring k next to the axis' own stiffness K blocks the share k/(k + K).
    """
    share = min(abs(fitted["blocked"]), _MAX_BLOCKED_SHARE)
    return {
        "place": fitted["place"],
        "stiffness": float(np.copysign(share / (1.0 - share), fitted["blocked"])),
    }


def _limit_place(
    values: Values, facts: AxisProperties, _bounds: Interval, extent: RecordCoverage
) -> Interval:
    """Return the range of places, from the low end, that leaves part of the travel free.

    An effect that acts at all positions is not a contact but a change of the characteristic.
    """
    lowest, highest = extent.reach
    strength = values.get("stiffness", values.get("blocked", 1.0))
    shares = (
        (1.0 - _MAX_CONTACT_TRAVEL_RATIO, 1.0)
        if strength >= 0.0
        else (0.0, _MAX_CONTACT_TRAVEL_RATIO)
    )
    low, high = ((lowest + share * (highest - lowest)) - facts.low for share in shares)
    return max(low, 0.0), min(high, facts.span)


CONTACT = Effect(
    id="contact",
    title="Contact",
    summary="A stop or a membrane: acts only beyond a position.",
    stage=EffectStage.MECHANICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=_start_from_places, domain={"place": _limit_place}, from_other=_convert_stop
    ),
    kinship=EffectRelations(
        prior=0.5, imitated_by=frozenset({EffectFamily.CURVE, EffectFamily.LIMIT})
    ),
    formulations=(
        Formulation(
            name="spring",
            equation="f = −(k δ + c δ̇), δ > 0 the depth beyond the place; never pulls",
            source="Laursen and Chawla, Int. J. Numer. Methods Eng. 40 (1997) 863–886",
            parameters=(_PLACE, _STIFFNESS, _DAMPING),
            acts=ForceFunction(step=compute_spring_force),
            prepare=_compute_spring_numbers,
            inner_step_s=_compute_inner_step,
            traits=_DISSIPATIVE,
        ),
        Formulation(
            name="progressive",
            equation="f = −(k D (δ/D)ⁿ + c δ̇), D a tenth of the range; n = 1.5: Hertz, 3: membrane",
            source="Johnson, Contact Mechanics (1985), ch. 4",
            parameters=(
                _PLACE,
                _STIFFNESS,
                _DAMPING,
                EffectParameter("exponent", "n", "", 1.0, 3.0, 1.5),
            ),
            acts=ForceFunction(step=compute_progressive_force),
            prepare=_compute_progressive_numbers,
            inner_step_s=_compute_inner_step,
            traits=_DISSIPATIVE,
        ),
        Formulation(
            name="stop",
            equation="y = x − β max(x − place, 0): the share β of what lies beyond is missing",
            source="definition",
            parameters=(
                _PLACE,
                EffectParameter("blocked", "β; negative: met on the way down", "", -1.0, 1.0, 0.8),
            ),
            acts=PositionFunction(step=block_motion),
            prepare=_compute_stop_numbers,
            traits=frozenset({EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT}),
        ),
    ),
)
