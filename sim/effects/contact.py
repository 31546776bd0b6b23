"""One-sided contact: a stop, a dish or a cell membrane; no effect before it.

The sign of the strength gives the side: positive for an obstacle met on the way up, negative for
one met on the way down. A fit therefore passes smoothly through "no contact" from one to the other.
"""

from collections.abc import Iterator
from math import inf, pi, sqrt

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Force,
    Formulation,
    Motion,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Extent, Identification, Interval, View
from rotemina.sim.effects.kinship import Family, Kinship

_INNER_SHARE = 1.0 / 30.0  # of the period of the axis in contact
_DEPTH = 0.1  # of the range, at which a progressive contact is as stiff as it is said to be


def spring(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Push as a spring and damper do that are met at a place.

    The force is the one whose work over the step equals the change of the spring's energy, with
    the depths before and after it (``δ₀``, and ``δ₁`` reduced by the force N itself,
    ``δ₁ − a N``): ``N (δ₁ − a N − δ₀) = k/2 (⟨δ₁ − a N⟩² − ⟨δ₀⟩²)``, ``⟨δ⟩ = max(δ, 0)``; a root
    of a quadratic at most, at any stiffness. The damper acts for the share of the step that is
    spent in contact, and nothing ever pulls.

    p: side, place, k, c.
    """
    middle = p[0] * (x - p[1])
    half = 0.5 * h * p[0] * other
    before, after = middle - half, middle + half
    share = 1.0
    if before > 0.0:
        push = p[2] * middle + p[3] * p[0] * other
        push = max(push / (1.0 + 0.5 * p[2] * a + p[3] * b), 0.0)
        if after - a * push > 0.0:  # it stays
            return -p[0] * push
        root = np.sqrt(half * half + 0.5 * p[2] * a * before * before)
        push = 0.5 * p[2] * before * before / (root - half)
        share = before / (before - after + a * push)
    elif after > 0.0:  # it comes
        linear = 2.0 * half + p[2] * a * after
        root = np.sqrt(4.0 * half * half - 2.0 * p[2] * a * after * before)
        push = p[2] * after * after / (linear + root)
        inside = after - a * push
        share = inside / (inside - before)
    else:
        return 0.0
    loss = share * p[3]
    push = (push + loss * p[0] * other) / (1.0 + loss * b)
    return -p[0] * max(push, 0.0)


def progressive(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Push by ``N = k D (δ/D)ⁿ`` and a damper, with δ at mid-step, where ``a N/2`` moves it.

    Newton's steps from N = 0 stay below the root, for the right side is convex.

    p: side, place, k, c, n, D.
    """
    depth = p[0] * (x - p[1])
    if depth <= 0.0:
        return 0.0
    push = 0.0
    for _ in range(3):
        inside = depth - 0.5 * a * push
        force = p[2] * p[5] * (inside / p[5]) ** p[4]
        push -= (push - force) / (1.0 + 0.5 * a * p[4] * force / inside)
    half = 0.5 * h * abs(other)
    loss = p[3] if depth >= half else p[3] * depth / half  # a mere touch meets no jump
    push = (push + loss * p[0] * other) / (1.0 + loss * b)
    return -p[0] * max(push, 0.0)


def stop(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Leave only a share of the motion beyond a place. p: side, place, share that is blocked."""
    return x - p[2] * p[0] * max(p[0] * (x - p[1]), 0.0)


def _side(strength: float) -> float:
    return -1.0 if strength < 0.0 else 1.0


def _stiffness(values: Values, facts: Facts) -> float:
    """Return the stiffness in contact; a free axis is measured by its full force over its range."""
    own = facts.stiffness if facts.stiffness > 0.0 else facts.force / facts.span
    return abs(values["stiffness"]) * own


def _numbers(values: Values, facts: Facts) -> tuple[float, ...]:
    """Make c the damping that goes with ``c = 2ζ k/ω`` at the frequency of the axis alone."""
    stiffness = _stiffness(values, facts)
    damping = stiffness * values["damping_ratio"] / (pi * facts.pace_hz)
    return (_side(values["stiffness"]), facts.low + values["place"], stiffness, damping)


def _progressive_numbers(values: Values, facts: Facts) -> tuple[float, ...]:
    return (*_numbers(values, facts), values["exponent"], _DEPTH * facts.span)


def _stop_numbers(values: Values, facts: Facts) -> tuple[float, ...]:
    return (_side(values["blocked"]), facts.low + values["place"], abs(values["blocked"]))


def _inner_step(values: Values, facts: Facts) -> float:
    stiffness = facts.stiffness + _stiffness(values, facts) * values.get("exponent", 1.0)
    return _INNER_SHARE * 2.0 * pi * sqrt(facts.mass / stiffness) if stiffness > 0.0 else inf


_PLACE = Parameter(
    "place",
    "position of the contact, from the low end of the range",
    "q",
    0.01,
    0.99,
    0.7,
    per="span",
)
_STIFFNESS = Parameter(
    "stiffness",
    "relative to the axis' own stiffness; negative: met on the way down",
    "",
    -30.0,
    30.0,
    0.5,
)
_DAMPING = Parameter("damping_ratio", "ζ, damping ratio of the contact", "", 0.0, 2.0, 0.1)
_DISSIPATIVE = frozenset({Trait.MEMORYLESS, Trait.DISSIPATIVE})

_PLACES = (0.4, 0.6, 0.8, 0.92)  # of the way to the end where something is met
_SOONER = (0.0, 0.03, 0.08)  # of the travel, that a soft contact begins before a stop's place
_STIFFER = (1.0, 3.0)
_ALL_BUT = 0.96  # share blocked by a contact as stiff as one can be
_TOUCHED = 0.7  # of the way that an axis goes, over which a contact may act


def _places(view: View) -> Iterator[Values]:
    """Give places where a contact may be met on the way up, and on the way down."""
    values, (least, most) = view.values, view.extent.reach
    low, high = view.bounds("place")
    strength = next(name for name in ("stiffness", "blocked") if name in values)
    if view.given:  # a crude form was fitted there
        place, hard = values["place"], values[strength]
        for before in _SOONER:
            sooner = place - float(np.sign(hard)) * before * (most - least)
            for times in _STIFFER:
                yield {"place": sooner, strength: hard * times}
        return
    for sign in (1.0, -1.0):
        for share in _PLACES:
            place = least if sign < 0.0 else most
            place -= sign * (1.0 - share) * (most - least)
            yield {
                "place": float(np.clip(place - view.facts.low, low, high)),
                strength: sign * abs(values[strength]),
            }


def _from_stop(fitted: Values) -> Values:
    """Return position and stiffness of a contact whose crude form blocks a share of the motion.

    A spring k next to the axis' own K takes the share k/(k + K).
    """
    share = min(abs(fitted["blocked"]), _ALL_BUT)
    return {
        "place": fitted["place"],
        "stiffness": float(np.copysign(share / (1.0 - share), fitted["blocked"])),
    }


def _met_on_the_way(values: Values, facts: Facts, _bounds: Interval, extent: Extent) -> Interval:
    """Return possible positions of a contact, from the low end: part of the travel is free.

    An effect that acts at all positions is not a contact but another characteristic.
    """
    least, most = extent.reach
    strength = values.get("stiffness", values.get("blocked", 1.0))
    shares = (1.0 - _TOUCHED, 1.0) if strength >= 0.0 else (0.0, _TOUCHED)
    low, high = ((least + share * (most - least)) - facts.low for share in shares)
    return max(low, 0.0), min(high, facts.span)


CONTACT = Effect(
    id="contact",
    title="Contact",
    summary="A stop or a membrane: acts only beyond a position.",
    stage=Stage.MECHANICS,
    kinds=EVERY_KIND,
    identification=Identification(
        starts=_places, domain={"place": _met_on_the_way}, from_other=_from_stop
    ),
    kinship=Kinship(prior=0.5, imitated_by=frozenset({Family.CURVE, Family.LIMIT})),
    formulations=(
        Formulation(
            name="spring",
            equation="f = −(k δ + c δ̇), δ > 0 the depth beyond the place; never pulls",
            source="Laursen and Chawla, Int. J. Numer. Methods Eng. 40 (1997) 863–886",
            parameters=(_PLACE, _STIFFNESS, _DAMPING),
            acts=Force(step=spring),
            prepare=_numbers,
            inner_step_s=_inner_step,
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
                Parameter("exponent", "n", "", 1.0, 3.0, 1.5),
            ),
            acts=Force(step=progressive),
            prepare=_progressive_numbers,
            inner_step_s=_inner_step,
            traits=_DISSIPATIVE,
        ),
        Formulation(
            name="stop",
            equation="y = x − β max(x − place, 0): the share β of what lies beyond is missing",
            source="definition",
            parameters=(
                _PLACE,
                Parameter("blocked", "β; negative: met on the way down", "", -1.0, 1.0, 0.8),
            ),
            acts=Motion(step=stop),
            prepare=_stop_numbers,
            traits=frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT}),
        ),
    ),
)
