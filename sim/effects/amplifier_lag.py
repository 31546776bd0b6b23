"""Bandwidth of an amplifier: fast changes arrive late and attenuated.

The parameter is a time constant τ, not a bandwidth ``1/(2πτ)``: the effect grows in proportion to
τ, and τ = 0 is exactly an amplifier without lag. A fit needs no infinite value for that.

The mechanics receive the exact mean of the output over each inner step. This mean, held over the
inner step, has the right impulse. The response to a step change of the input is therefore off by
only about ``(ωh)²/12`` of its height, however short τ is. Here ω is the natural angular frequency
of the axis, and h is the inner step. So the inner step depends only on the axis, and the response
is a smooth function of τ.
"""

from math import inf

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
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
from rotemina.sim.effects.starts import (
    compute_lag_delay,
    compute_lag_delay_ratio,
    start_from_delays,
)

# Inner step in periods of the axis: the step response is then accurate to 0.2 % of its height.
_INNER_STEP_PERIODS = 1.0 / 40.0


def apply_first_order_lag(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``τ ẏ + y = x``. p: τ; s: y."""
    if p[0] <= 0.0:
        s[0] = x
        return x
    if h == 0.0:
        return s[0]
    error = s[0] - x
    decayed_fraction = -np.expm1(-h / p[0])
    s[0] = x + error * (1.0 - decayed_fraction)
    return x + error * decayed_fraction * p[0] / h


def apply_second_order_lag(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``τ² ÿ + 2ζτ ẏ + y = x``; its integral over the step gives the mean.

    With ``e = y − x``, ``z = τ ẏ``, ``θ = h/τ`` and ``w = √|1 − ζ²|``: ``e₁ = C e + S (z + ζ e)``
    and ``z₁ = C z − S (ζ z + e)``, where ``C = exp(−ζθ) cos wθ`` and ``S = exp(−ζθ) sin(wθ)/w``,
    or their hyperbolic forms for ζ > 1.

    p: τ, ζ; s: y, z.
    """
    if p[0] <= 0.0:
        s[0], s[1] = x, 0.0
        return x
    if h == 0.0:
        return s[0]
    damping_ratio, theta = p[1], h / p[0]
    root_distance = np.sqrt(abs(1.0 - damping_ratio * damping_ratio))
    if damping_ratio < 1.0:
        decay = np.exp(-damping_ratio * theta)
        damped_cosine, damped_sine = (
            decay * np.cos(root_distance * theta),
            decay * np.sin(root_distance * theta) / root_distance,
        )
    else:
        # This is (ζ − w) θ without cancellation.
        decay = np.exp(-theta / (damping_ratio + root_distance))
        decayed_fraction = -np.expm1(-2.0 * root_distance * theta)
        damped_cosine = decay * (1.0 - 0.5 * decayed_fraction)
        damped_sine = (
            decay * decayed_fraction / (2.0 * root_distance)
            if root_distance > 0.0
            else decay * theta
        )
    error, speed = s[0] - x, s[1]
    error_after = damped_cosine * error + damped_sine * (speed + damping_ratio * error)
    speed_after = damped_cosine * speed - damped_sine * (damping_ratio * speed + error)
    s[0], s[1] = x + error_after, speed_after
    return x - (speed_after - speed + 2.0 * damping_ratio * (error_after - error)) / theta


def apply_third_order_lag(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``τ₁ u̇ + u = x``, then ``τ² ÿ + 2ζτ ẏ + y = u`` with τ₁ = r τ and ζ < 1.

    While x is held, u approaches it by ``g exp(−t/τ₁)``, and y follows ``x + G exp(−t/τ₁)`` with
    ``G = g/(1 − 2ζ/r + 1/r²)`` (``forced`` in the code). The difference is a free oscillation, as
    in `apply_second_order_lag`.

    p: τ, ζ, r; s: y, τ ẏ, u.
    """
    if p[0] <= 0.0:
        s[0], s[1], s[2] = x, 0.0, x
        return x
    if h == 0.0:
        return s[0]
    damping_ratio, theta, rate_ratio = p[1], h / p[0], 1.0 / p[2]
    root_distance = np.sqrt(1.0 - damping_ratio * damping_ratio)
    decay = np.exp(-damping_ratio * theta)
    damped_cosine, damped_sine = (
        decay * np.cos(root_distance * theta),
        decay * np.sin(root_distance * theta) / root_distance,
    )
    decayed_fraction = -np.expm1(-theta * rate_ratio)
    forced = (s[2] - x) / (1.0 - 2.0 * damping_ratio * rate_ratio + rate_ratio * rate_ratio)
    error, speed = s[0] - x - forced, s[1] + forced * rate_ratio
    error_after = damped_cosine * error + damped_sine * (speed + damping_ratio * error)
    speed_after = damped_cosine * speed - damped_sine * (damping_ratio * speed + error)
    forced_after = forced * (1.0 - decayed_fraction)
    s[0], s[1] = x + forced_after + error_after, speed_after - forced_after * rate_ratio
    s[2] = x + (s[2] - x) * (1.0 - decayed_fraction)
    forced_mean = forced * decayed_fraction / (theta * rate_ratio)
    return (
        x
        + forced_mean
        - (speed_after - speed + 2.0 * damping_ratio * (error_after - error)) / theta
    )


def compute_inner_step(values: Values, facts: AxisProperties) -> float:
    """Return the longest step, s, over which the mean of the output may be held.

    An axis without inertia follows the output itself at each sample, which is exact.
    """
    needs_no_inner_step = values.get("time_constant") == 0.0 or facts.is_static
    return inf if needs_no_inner_step else _INNER_STEP_PERIODS / facts.pace_hz


TIME_CONSTANT = EffectParameter("time_constant", "τ; the bandwidth is 1/(2πτ)", "s", 0.0, 0.1, 5e-4)
_SOURCE = (
    "Fleming and Leang, Design, Modeling and Control of Nanopositioning Systems (2014), ch. 14"
)
_LINEAR_TRAITS = frozenset({EffectTrait.LINEAR, EffectTrait.TRANSIENT, EffectTrait.MEMORYLESS})

AMPLIFIER_LAG = Effect(
    id="amplifier_lag",
    title="Amplifier lag",
    summary="Phase and gain both fall with frequency; a recorded u shows it.",
    stage=EffectStage.ELECTRONICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=start_from_delays("time_constant", (0.5, 2.0, 8.0), compute_lag_delay_ratio),
        lateness_s=compute_lag_delay,
    ),
    kinship=EffectRelations(family=EffectFamily.LATE, prior=0.6),
    formulations=(
        Formulation(
            name="first_order",
            equation="τ ẏ + y = x",
            source=_SOURCE,
            parameters=(TIME_CONSTANT,),
            acts=InputFunction(step=apply_first_order_lag, states=1, timed=True),
            inner_step_s=compute_inner_step,
            traits=_LINEAR_TRAITS,
        ),
        Formulation(
            name="second_order",
            equation="τ² ÿ + 2ζτ ẏ + y = x",
            source=_SOURCE,
            parameters=(TIME_CONSTANT, EffectParameter("damping_ratio", "ζ", "", 0.05, 5.0, 0.7)),
            acts=InputFunction(step=apply_second_order_lag, states=2, timed=True),
            inner_step_s=compute_inner_step,
            traits=_LINEAR_TRAITS,
        ),
        Formulation(
            name="third_order",
            equation="r τ u̇ + u = x, τ² ÿ + 2ζτ ẏ + y = u",
            source=_SOURCE,
            parameters=(
                TIME_CONSTANT,
                EffectParameter(
                    "damping_ratio", "ζ; 0.5 with r = 1: Butterworth", "", 0.05, 0.95, 0.5
                ),
                EffectParameter("ratio", "r, ratio of both time constants", "", 0.05, 20.0, 1.0),
            ),
            acts=InputFunction(step=apply_third_order_lag, states=3, timed=True),
            inner_step_s=compute_inner_step,
            traits=_LINEAR_TRAITS,
        ),
    ),
)
