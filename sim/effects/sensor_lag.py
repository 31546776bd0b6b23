"""Lag of a sensor: the low-pass filter of its electronics.

Between two calls the position is assumed to move along a straight line, for which the filters are
stepped exactly ("triangle hold": Franklin, Powell, Workman, Digital Control of Dynamic Systems, 3rd
ed. (1998), section 6.3.2). They are therefore correct for any time constant, even far below the
sampling interval. The only error is that of the straight line: ``(ω h)²/12`` for a vibration at ω.
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
    ReadingFunction,
    Values,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import (
    compute_lag_delay,
    compute_lag_delay_ratio,
    start_from_delays,
)

# Inner step in periods of the axis: ``(ω h)²/12`` is then 0.2 %.
_INNER_STEP_PERIODS = 1.0 / 40.0
# Inner step of an axis without stiffness, which has no period.
_FREE_AXIS_STEP_S = 1e-3
# Lower limit of √|1 − ζ²|: below it the two roots are numerically equal.
_MIN_ROOT_DISTANCE = 1e-6


def apply_first_order_lag(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``T ẏ + y = x``. p: T; s: x and y of the last call."""
    if p[0] <= 0.0:
        s[0] = s[1] = x
        return x
    if h > 0.0:
        lag = p[0] * (x - s[0]) / h
        s[1] = x - lag + np.exp(-h / p[0]) * (s[1] - s[0] + lag)
        s[0] = x
    return s[1]


def apply_second_order_lag(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``T² ÿ + 2ζT ẏ + y = x``. p: T, ζ; s: x, y and T ẏ of the last call.

    The error ``e = y − x + 2ζT ẋ`` along a straight line is that of a free oscillator.
    """
    if p[0] <= 0.0:
        s[0], s[1], s[2] = x, x, 0.0
        return x
    if h > 0.0:
        theta = h / p[0]
        ramp = p[0] * (x - s[0]) / h
        error = s[1] - s[0] + 2.0 * p[1] * ramp
        speed = s[2] - ramp
        root_distance = max(np.sqrt(abs(1.0 - p[1] * p[1])), _MIN_ROOT_DISTANCE)
        if p[1] < 1.0:
            decay = np.exp(-p[1] * theta)
            even = decay * np.cos(root_distance * theta)
            odd = decay * np.sin(root_distance * theta) / root_distance
        else:
            slow_decay = np.exp((root_distance - p[1]) * theta)
            # Decay factor of the faster root relative to the slower one, minus 1.
            relative_decay = np.expm1(-2.0 * root_distance * theta)
            even = slow_decay * (1.0 + 0.5 * relative_decay)
            odd = -0.5 * slow_decay * relative_decay / root_distance
        s[1] = x - 2.0 * p[1] * ramp + even * error + odd * (p[1] * error + speed)
        s[2] = ramp + even * speed - odd * (error + p[1] * speed)
        s[0] = x
    return s[1]


def apply_third_order_lag(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``T₁ u̇ + u = x``, then ``T² ÿ + 2ζT ẏ + y = u`` with T₁ = r T and ζ < 1.

    Along a straight line u finally lags by T₁, and y by ``T₁ + 2ζT``. The deviation of u decays;
    that of y follows it and also oscillates freely.

    p: T, ζ, r; s: x, y, T ẏ and u of the last call.
    """
    if p[0] <= 0.0:
        s[0], s[1], s[2], s[3] = x, x, 0.0, x
        return x
    if h > 0.0:
        theta, rate_ratio = h / p[0], 1.0 / p[2]
        ramp = p[0] * (x - s[0]) / h
        first_lag = p[2] * ramp
        lag = first_lag + 2.0 * p[1] * ramp
        deviation = s[3] - s[0] + first_lag
        forced = deviation / (1.0 - 2.0 * p[1] * rate_ratio + rate_ratio * rate_ratio)
        error = s[1] - s[0] + lag - forced
        speed = s[2] - ramp + forced * rate_ratio
        root_distance = np.sqrt(1.0 - p[1] * p[1])
        decay = np.exp(-p[1] * theta)
        even = decay * np.cos(root_distance * theta)
        odd = decay * np.sin(root_distance * theta) / root_distance
        first_decay = np.exp(-theta * rate_ratio)
        s[1] = x - lag + forced * first_decay + even * error + odd * (p[1] * error + speed)
        s[2] = (
            ramp - forced * rate_ratio * first_decay + even * speed - odd * (error + p[1] * speed)
        )
        s[3] = x - first_lag + deviation * first_decay
        s[0] = x
    return s[1]


def _compute_inner_step(values: Values, facts: AxisProperties) -> float:
    """Return the longest step, s, within which the motion is nearly a straight line."""
    if values["time_constant"] <= 0.0 or facts.mass <= 0.0:
        return inf
    return (
        _INNER_STEP_PERIODS / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_AXIS_STEP_S
    )


_TIME_CONSTANT = EffectParameter("time_constant", "T", "s", 0.0, 0.1, 5e-4)
_TRAITS = frozenset(
    {EffectTrait.LINEAR, EffectTrait.MEMORYLESS, EffectTrait.TRANSIENT, EffectTrait.READING_ONLY}
)
_SOURCE = "Fleming, Sensors and Actuators A 190 (2013) 106–126, section 2.5"

SENSOR_LAG = Effect(
    id="sensor_lag",
    title="Sensor lag",
    summary="Phase and gain of the reading fall with frequency; those of the motion do not.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=start_from_delays("time_constant", (0.5, 2.0, 8.0), compute_lag_delay_ratio),
        lateness_s=compute_lag_delay,
    ),
    kinship=EffectRelations(family=EffectFamily.LATE, prior=0.3),
    formulations=(
        Formulation(
            name="first_order",
            equation="T ẏ + y = q",
            source=_SOURCE,
            parameters=(_TIME_CONSTANT,),
            acts=ReadingFunction(step=apply_first_order_lag, states=2),
            inner_step_s=_compute_inner_step,
            traits=_TRAITS,
        ),
        Formulation(
            name="second_order",
            equation="T² ÿ + 2ζT ẏ + y = q",
            source=_SOURCE,
            parameters=(
                _TIME_CONSTANT,
                EffectParameter("damping_ratio", "ζ; 0.707: Butterworth", "", 0.05, 5.0, 0.7071),
            ),
            acts=ReadingFunction(step=apply_second_order_lag, states=3),
            inner_step_s=_compute_inner_step,
            traits=_TRAITS,
        ),
        Formulation(
            name="third_order",
            equation="r T u̇ + u = q, T² ÿ + 2ζT ẏ + y = u",
            source=_SOURCE,
            parameters=(
                _TIME_CONSTANT,
                EffectParameter(
                    "damping_ratio", "ζ; 0.5 with r = 1: Butterworth", "", 0.05, 0.95, 0.5
                ),
                EffectParameter("ratio", "r, ratio of both time constants", "", 0.05, 20.0, 1.0),
            ),
            acts=ReadingFunction(step=apply_third_order_lag, states=4),
            inner_step_s=_compute_inner_step,
            traits=_TRAITS,
        ),
    ),
)
