"""A sensor that lags: the low-pass of its electronics.

Between two calls the position is assumed to move along a straight line, for which the filters are
stepped exactly ("triangle hold": Franklin, Powell, Workman, Digital Control of Dynamic Systems, 3rd
ed. (1998), section 6.3.2). They are therefore correct for any time constant, even far below the
sampling interval, and the error is that of the straight line: ``(ω h)²/12`` of a vibration.
"""

from math import inf

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Parameter,
    Reading,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import lag_lateness, lag_share, late

_INNER_SHARE = 1.0 / 40.0  # of the axis' period: (ω h)²/12 is 0.2 %
_FREE_STEP_S = 1e-3  # where no spring sets a period
_NEAR_CRITICAL = 1e-6  # the least √|1 − ζ²|: in between the two kinds of roots are one


def first_order(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``T ẏ + y = x``. p: T; s: x and y when last called."""
    if p[0] <= 0.0:
        s[0] = s[1] = x
        return x
    if h > 0.0:
        behind = p[0] * (x - s[0]) / h
        s[1] = x - behind + np.exp(-h / p[0]) * (s[1] - s[0] + behind)
        s[0] = x
    return s[1]


def second_order(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``T² ÿ + 2ζT ẏ + y = x``. p: T, ζ; s: x, y and T ẏ when last called.

    The error ``e = y − x + 2ζT ẋ`` along a straight line is that of a free oscillator.
    """
    if p[0] <= 0.0:
        s[0], s[1], s[2] = x, x, 0.0
        return x
    if h > 0.0:
        pace = h / p[0]
        drift = p[0] * (x - s[0]) / h
        error = s[1] - s[0] + 2.0 * p[1] * drift
        speed = s[2] - drift
        apart = max(np.sqrt(abs(1.0 - p[1] * p[1])), _NEAR_CRITICAL)
        if p[1] < 1.0:
            fading = np.exp(-p[1] * pace)
            even = fading * np.cos(apart * pace)
            odd = fading * np.sin(apart * pace) / apart
        else:
            slow = np.exp((apart - p[1]) * pace)
            gap = np.expm1(-2.0 * apart * pace)  # of the faster root from the slower, relative
            even = slow * (1.0 + 0.5 * gap)
            odd = -0.5 * slow * gap / apart
        s[1] = x - 2.0 * p[1] * drift + even * error + odd * (p[1] * error + speed)
        s[2] = drift + even * speed - odd * (error + p[1] * speed)
        s[0] = x
    return s[1]


def third_order(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``T₁ u̇ + u = x``, then ``T² ÿ + 2ζT ẏ + y = u`` with T₁ = r T and ζ < 1.

    Along a straight line u and y come to lag by T₁ and ``T₁ + 2ζT``; the deviation of u decays, and
    that of y is also a free oscillation.

    p: T, ζ, r; s: x, y, T ẏ and u of the last call.
    """
    if p[0] <= 0.0:
        s[0], s[1], s[2], s[3] = x, x, 0.0, x
        return x
    if h > 0.0:
        pace, share = h / p[0], 1.0 / p[2]
        drift = p[0] * (x - s[0]) / h
        first = p[2] * drift
        behind = first + 2.0 * p[1] * drift
        off = s[3] - s[0] + first
        lead = off / (1.0 - 2.0 * p[1] * share + share * share)
        error = s[1] - s[0] + behind - lead
        speed = s[2] - drift + lead * share
        apart = np.sqrt(1.0 - p[1] * p[1])
        fading = np.exp(-p[1] * pace)
        even = fading * np.cos(apart * pace)
        odd = fading * np.sin(apart * pace) / apart
        fallen = np.exp(-pace * share)
        s[1] = x - behind + lead * fallen + even * error + odd * (p[1] * error + speed)
        s[2] = drift - lead * share * fallen + even * speed - odd * (error + p[1] * speed)
        s[3] = x - first + off * fallen
        s[0] = x
    return s[1]


def _between_samples(values: Values, facts: Facts) -> float:
    """Return a step along which a ringing axis moves straight enough; static ones stand still."""
    if values["time_constant"] <= 0.0 or facts.mass <= 0.0:
        return inf
    return _INNER_SHARE / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_STEP_S


_TIME_CONSTANT = Parameter("time_constant", "T", "s", 0.0, 0.1, 5e-4)
_TRAITS = frozenset({Trait.LINEAR, Trait.MEMORYLESS, Trait.TRANSIENT, Trait.READING_ONLY})
_SOURCE = "Fleming, Sensors and Actuators A 190 (2013) 106–126, section 2.5"

SENSOR_LAG = Effect(
    id="sensor_lag",
    title="Sensor lag",
    summary="Phase and gain of the reading fall with frequency; those of the motion do not.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    identification=Identification(
        starts=late("time_constant", (0.5, 2.0, 8.0), lag_share), lateness_s=lag_lateness
    ),
    kinship=Kinship(family=Family.LATE, prior=0.3),
    formulations=(
        Formulation(
            name="first_order",
            equation="T ẏ + y = q",
            source=_SOURCE,
            parameters=(_TIME_CONSTANT,),
            acts=Reading(step=first_order, states=2),
            inner_step_s=_between_samples,
            traits=_TRAITS,
        ),
        Formulation(
            name="second_order",
            equation="T² ÿ + 2ζT ẏ + y = q",
            source=_SOURCE,
            parameters=(
                _TIME_CONSTANT,
                Parameter("damping_ratio", "ζ; 0.707: Butterworth", "", 0.05, 5.0, 0.7071),
            ),
            acts=Reading(step=second_order, states=3),
            inner_step_s=_between_samples,
            traits=_TRAITS,
        ),
        Formulation(
            name="third_order",
            equation="r T u̇ + u = q, T² ÿ + 2ζT ẏ + y = u",
            source=_SOURCE,
            parameters=(
                _TIME_CONSTANT,
                Parameter("damping_ratio", "ζ; 0.5 with r = 1: Butterworth", "", 0.05, 0.95, 0.5),
                Parameter("ratio", "r, ratio of both time constants", "", 0.05, 20.0, 1.0),
            ),
            acts=Reading(step=third_order, states=4),
            inner_step_s=_between_samples,
            traits=_TRAITS,
        ),
    ),
)
