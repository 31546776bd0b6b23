"""Outliers of a sensor: spikes and dropouts.

One standard normal variate per sample decides whether the sample is an outlier. An outlier occurs
if the probability of an even larger variate is below the probability of an outlier; the ratio of
the two then gives its size. Such contaminated samples are treated by Barnett and Lewis, Outliers in
Statistical Data, 3rd ed. (1994).
"""

from math import erfc

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    ReadingFunction,
)
from rotemina.sim.effects.identification import EffectSignature, IdentificationHints

_SQRT_HALF = 0.5**0.5


def add_spikes(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Shift a sample to either side by 1/2 to 3/2 of the size. p: rate, size."""
    # A run without noise has no outliers.
    if a == 0.0:
        return x
    probability = -np.expm1(-p[0] * h)
    tail_probability = 0.5 * erfc(a * _SQRT_HALF)
    if tail_probability >= probability:
        return x
    relative_shift = 2.0 * tail_probability / probability - 1.0
    return x + p[1] * (relative_shift + (0.5 if relative_shift > 0.0 else -0.5))


def drop_to_zero(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the sensor's zero during a dropout. p: rate, duration; s: end of the dropout."""
    if a == 0.0:
        return x
    if 0.5 * erfc(a * _SQRT_HALF) < -np.expm1(-p[0] * h):
        s[0] = t + p[1]
        return 0.0
    return 0.0 if t < s[0] else x


def hold_last_value(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the last value during a dropout.

    p: rate, duration; s: end of the dropout, last value.
    """
    if a != 0.0:
        if 0.5 * erfc(a * _SQRT_HALF) < -np.expm1(-p[0] * h):
            s[0] = t + p[1]
            return s[1]
        if t < s[0]:
            return s[1]
    s[1] = x
    return x


_RATE = EffectParameter("rate", "rate of occurrence", "1/s", 0.0, 100.0, 1.0)
_DURATION = EffectParameter("duration", "duration of a dropout; 0: one sample", "s", 0.0, 1.0, 0.0)
_SOURCE = "Barnett and Lewis, Outliers in Statistical Data, 3rd ed. (1994), ch. 2"
_TRAITS = frozenset({EffectTrait.RANDOM, EffectTrait.READING_ONLY})

SENSOR_OUTLIERS = Effect(
    id="sensor_outliers",
    title="Sensor outliers",
    summary="Single wrong samples: spikes or dropouts of the reading.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(shows_as=EffectSignature.SPIKES),
    formulations=(
        Formulation(
            name="spikes",
            equation="y = q ± A (1/2 … 3/2) at samples of a Poisson process",
            source=_SOURCE,
            parameters=(_RATE, EffectParameter("size", "A, mean", "q", 0.0, 1.0, 0.01, per="span")),
            acts=ReadingFunction(step=add_spikes, random=True),
            traits=_TRAITS,
        ),
        Formulation(
            name="dropouts_to_zero",
            equation="y = 0 for a while after events of a Poisson process",
            source=_SOURCE,
            parameters=(_RATE, _DURATION),
            acts=ReadingFunction(step=drop_to_zero, states=1, random=True, digital=True),
            traits=_TRAITS,
        ),
        Formulation(
            name="dropouts_held",
            equation="y = the last reading for a while after events of a Poisson process",
            source=_SOURCE,
            parameters=(_RATE, _DURATION),
            acts=ReadingFunction(step=hold_last_value, states=2, random=True, digital=True),
            traits=_TRAITS,
        ),
    ),
)
