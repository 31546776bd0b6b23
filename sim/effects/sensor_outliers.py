"""Outliers of a sensor: spikes and dropouts.

One standard normal variate per sample decides: the share of variates above it tells whether an
outlier occurs, and its place within that share tells which (Barnett and Lewis, Outliers in
Statistical Data, 3rd ed. (1994), treats such contaminated samples).
"""

from math import erfc

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Parameter,
    Reading,
    Stage,
    Trait,
)
from rotemina.sim.effects.identification import Identification, Sign

_HALF_ROOT = 0.5**0.5


def spikes(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Put a sample off to either side by 1/2 to 3/2 of the size. p: rate, size."""
    if a == 0.0:  # no chance
        return x
    chance = -np.expm1(-p[0] * h)
    above = 0.5 * erfc(a * _HALF_ROOT)
    if above >= chance:
        return x
    place = 2.0 * above / chance - 1.0
    return x + p[1] * (place + (0.5 if place > 0.0 else -0.5))


def zeros(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Read the sensor's zero while it is lost. p: rate, duration; s: until when."""
    if a == 0.0:
        return x
    if 0.5 * erfc(a * _HALF_ROOT) < -np.expm1(-p[0] * h):
        s[0] = t + p[1]
        return 0.0
    return 0.0 if t < s[0] else x


def held(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Read the last value while it is lost. p: rate, duration; s: until when, last value."""
    if a != 0.0:
        if 0.5 * erfc(a * _HALF_ROOT) < -np.expm1(-p[0] * h):
            s[0] = t + p[1]
            return s[1]
        if t < s[0]:
            return s[1]
    s[1] = x
    return x


_RATE = Parameter("rate", "rate of occurrence", "1/s", 0.0, 100.0, 1.0)
_DURATION = Parameter("duration", "duration of a dropout; 0: one sample", "s", 0.0, 1.0, 0.0)
_SOURCE = "Barnett and Lewis, Outliers in Statistical Data, 3rd ed. (1994), ch. 2"
_TRAITS = frozenset({Trait.RANDOM, Trait.READING_ONLY})

SENSOR_OUTLIERS = Effect(
    id="sensor_outliers",
    title="Sensor outliers",
    summary="Single wrong samples: spikes or dropouts of the reading.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    identification=Identification(shows_as=Sign.SPIKES),
    formulations=(
        Formulation(
            name="spikes",
            equation="y = q ± A (1/2 … 3/2) at samples of a Poisson process",
            source=_SOURCE,
            parameters=(_RATE, Parameter("size", "A, mean", "q", 0.0, 1.0, 0.01, per="span")),
            acts=Reading(step=spikes, random=True),
            traits=_TRAITS,
        ),
        Formulation(
            name="dropouts_to_zero",
            equation="y = 0 for a while after events of a Poisson process",
            source=_SOURCE,
            parameters=(_RATE, _DURATION),
            acts=Reading(step=zeros, states=1, random=True, digital=True),
            traits=_TRAITS,
        ),
        Formulation(
            name="dropouts_held",
            equation="y = the last reading for a while after events of a Poisson process",
            source=_SOURCE,
            parameters=(_RATE, _DURATION),
            acts=Reading(step=held, states=2, random=True, digital=True),
            traits=_TRAITS,
        ),
    ),
)
