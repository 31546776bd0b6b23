"""Bandwidth of an amplifier: fast changes arrive late and attenuated.

The parameter is a time constant τ, not a bandwidth ``1/(2πτ)``: the effect starts in proportion to
τ, and τ = 0 is exactly an amplifier without lag. A fit needs no infinity for that.

The mechanics get the mean of the output over each step, which is exact. Held, it has the right
impulse, so the answer to a step of the input is off by about ``(ωh)²/12`` of its height, with ω the
axis' own rate and h the step, however short τ is. The inner step therefore depends only on the
axis, and the answer stays smooth in τ.
"""

from math import inf

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
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
from rotemina.sim.effects.starts import lag_lateness, lag_share, late

_INNER_SHARE = 1.0 / 40.0  # of the axis' period: steps are answered to 0.2 % of their height


def first_order(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``τ ẏ + y = x``. p: τ; s: y."""
    if p[0] <= 0.0:
        s[0] = x
        return x
    if h == 0.0:
        return s[0]
    gap = s[0] - x
    fallen = -np.expm1(-h / p[0])
    s[0] = x + gap * (1.0 - fallen)
    return x + gap * fallen * p[0] / h


def second_order(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``τ² ÿ + 2ζτ ẏ + y = x``; its integral over the step gives the mean.

    With ``e = y − x``, ``z = τ ẏ``, ``θ = h/τ`` and ``w = √|1 − ζ²|``: ``e₁ = C e + S (z + ζ e)``
    and ``z₁ = C z − S (ζ z + e)``, where ``C = exp(−ζθ) cos wθ`` and ``S = exp(−ζθ) sin(wθ)/w``,
    hyperbolic for ζ > 1.

    p: τ, ζ; s: y, z.
    """
    if p[0] <= 0.0:
        s[0], s[1] = x, 0.0
        return x
    if h == 0.0:
        return s[0]
    ratio, theta = p[1], h / p[0]
    width = np.sqrt(abs(1.0 - ratio * ratio))
    if ratio < 1.0:
        decay = np.exp(-ratio * theta)
        c, sine = decay * np.cos(width * theta), decay * np.sin(width * theta) / width
    else:
        decay = np.exp(-theta / (ratio + width))  # (ζ − w) θ without cancellation
        fallen = -np.expm1(-2.0 * width * theta)
        c = decay * (1.0 - 0.5 * fallen)
        sine = decay * fallen / (2.0 * width) if width > 0.0 else decay * theta
    gap, pace = s[0] - x, s[1]
    gap_after = c * gap + sine * (pace + ratio * gap)
    pace_after = c * pace - sine * (ratio * pace + gap)
    s[0], s[1] = x + gap_after, pace_after
    return x - (pace_after - pace + 2.0 * ratio * (gap_after - gap)) / theta


def third_order(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``τ₁ u̇ + u = x``, then ``τ² ÿ + 2ζτ ẏ + y = u`` with τ₁ = r τ and ζ < 1.

    While x is held, u approaches it by ``g exp(−t/τ₁)``, and y follows ``x + G exp(−t/τ₁)`` with
    ``G = g/(1 − 2ζ/r + 1/r²)``; the difference is a free oscillation, as in `second_order`.

    p: τ, ζ, r; s: y, τ ẏ, u.
    """
    if p[0] <= 0.0:
        s[0], s[1], s[2] = x, 0.0, x
        return x
    if h == 0.0:
        return s[0]
    ratio, theta, share = p[1], h / p[0], 1.0 / p[2]
    width = np.sqrt(1.0 - ratio * ratio)
    decay = np.exp(-ratio * theta)
    c, sine = decay * np.cos(width * theta), decay * np.sin(width * theta) / width
    fallen = -np.expm1(-theta * share)
    lead = (s[2] - x) / (1.0 - 2.0 * ratio * share + share * share)
    gap, pace = s[0] - x - lead, s[1] + lead * share
    gap_after = c * gap + sine * (pace + ratio * gap)
    pace_after = c * pace - sine * (ratio * pace + gap)
    left = lead * (1.0 - fallen)
    s[0], s[1] = x + left + gap_after, pace_after - left * share
    s[2] = x + (s[2] - x) * (1.0 - fallen)
    mean = lead * fallen / (theta * share)
    return x + mean - (pace_after - pace + 2.0 * ratio * (gap_after - gap)) / theta


def inner_step(values: Values, facts: Facts) -> float:
    """Return a step over which the mean of the output may be held.

    An axis without inertia takes the output itself at each sample, which is exact.
    """
    idle = values.get("time_constant") == 0.0 or facts.is_static
    return inf if idle else _INNER_SHARE / facts.pace_hz


TIME_CONSTANT = Parameter("time_constant", "τ; the bandwidth is 1/(2πτ)", "s", 0.0, 0.1, 5e-4)
_SOURCE = (
    "Fleming and Leang, Design, Modeling and Control of Nanopositioning Systems (2014), ch. 14"
)
_LINEAR = frozenset({Trait.LINEAR, Trait.TRANSIENT, Trait.MEMORYLESS})

AMPLIFIER_LAG = Effect(
    id="amplifier_lag",
    title="Amplifier lag",
    summary="Phase and gain both fall with frequency; a recorded u shows it.",
    stage=Stage.ELECTRONICS,
    kinds=EVERY_KIND,
    identification=Identification(
        starts=late("time_constant", (0.5, 2.0, 8.0), lag_share), lateness_s=lag_lateness
    ),
    kinship=Kinship(family=Family.LATE, prior=0.6),
    formulations=(
        Formulation(
            name="first_order",
            equation="τ ẏ + y = x",
            source=_SOURCE,
            parameters=(TIME_CONSTANT,),
            acts=Drive(step=first_order, states=1, timed=True),
            inner_step_s=inner_step,
            traits=_LINEAR,
        ),
        Formulation(
            name="second_order",
            equation="τ² ÿ + 2ζτ ẏ + y = x",
            source=_SOURCE,
            parameters=(TIME_CONSTANT, Parameter("damping_ratio", "ζ", "", 0.05, 5.0, 0.7)),
            acts=Drive(step=second_order, states=2, timed=True),
            inner_step_s=inner_step,
            traits=_LINEAR,
        ),
        Formulation(
            name="third_order",
            equation="r τ u̇ + u = x, τ² ÿ + 2ζτ ẏ + y = u",
            source=_SOURCE,
            parameters=(
                TIME_CONSTANT,
                Parameter("damping_ratio", "ζ; 0.5 with r = 1: Butterworth", "", 0.05, 0.95, 0.5),
                Parameter("ratio", "r, ratio of both time constants", "", 0.05, 20.0, 1.0),
            ),
            acts=Drive(step=third_order, states=3, timed=True),
            inner_step_s=inner_step,
            traits=_LINEAR,
        ),
    ),
)
