"""Sensor whose zero drifts while nothing moves."""

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
from rotemina.sim.effects.identification import EffectSignature, IdentificationHints

POLE_COUNT = 10
_SLOWEST_POLE_HZ = 1e-3
# Step lengths that differ by less than this, relatively, differ only by rounding.
_STEP_TOLERANCE_RATIO = 1e-9
# With this spacing the slope ripples by less than 2 %, and the last pole is at 250 Hz.
_POLE_SPACING_DECADES = 0.6


def add_random_walk(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + w``, ``dw = r √h a``. p: r; s: w."""
    s[0] += p[0] * np.sqrt(h) * a
    return x + s[0]


def add_flicker_noise(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + Σ wᵢ``, ``ẇᵢ = −pᵢ wᵢ + rᵢ n``, all driven by the same white noise n.

    n is held during h, so that components above the sampling rate do not alias.

    p: pᵢ, then rᵢ. s: wᵢ, then h and r₀ of the last call, then for each wᵢ its decay factor over h,
    and then for each wᵢ its change per unit of the random variate.
    """
    if h <= 0.0:
        y = x
        for i in range(POLE_COUNT):
            y += s[i]
        return y
    if abs(h - s[POLE_COUNT]) > _STEP_TOLERANCE_RATIO * h or p[POLE_COUNT] != s[POLE_COUNT + 1]:
        s[POLE_COUNT], s[POLE_COUNT + 1] = h, p[POLE_COUNT]
        for i in range(POLE_COUNT):
            s[POLE_COUNT + 2 + i] = np.exp(-p[i] * h)
            s[2 * POLE_COUNT + 2 + i] = (
                -np.expm1(-p[i] * h) * p[POLE_COUNT + i] / (p[i] * np.sqrt(h))
            )
    y = x
    for i in range(POLE_COUNT):
        s[i] = s[POLE_COUNT + 2 + i] * s[i] + s[2 * POLE_COUNT + 2 + i] * a
        y += s[i]
    return y


def _compute_cascade(values: Values, _facts: AxisProperties) -> tuple[float, ...]:
    """Return poles and residues of ``H = k Π (s + zⱼ) / Π (s + pᵢ)``, which falls as 1/√f.

    The poles are evenly spaced on a logarithmic scale, with a zero midway between neighbouring
    poles. k sets ``|H|² = 2 L²/f`` (one-sided) at the geometric mean of the outer poles.
    """
    poles = 2.0 * np.pi * _SLOWEST_POLE_HZ * 10.0 ** (_POLE_SPACING_DECADES * np.arange(POLE_COUNT))
    zeros = np.sqrt(poles[1:] * poles[:-1])
    residues = [
        float(np.prod(zeros - pole) / np.prod(np.delete(poles, i) - pole))
        for i, pole in enumerate(poles)
    ]
    middle = float(np.sqrt(poles[0] * poles[-1]))
    unscaled_gain = abs(np.sum(np.array(residues) / (1j * middle + poles)))
    gain = values["level"] / np.sqrt(2.0 * middle / (2.0 * np.pi))
    return (*poles.tolist(), *(residue * gain / unscaled_gain for residue in residues))


_TRAITS = frozenset({EffectTrait.RANDOM, EffectTrait.READING_ONLY, EffectTrait.LOCKED_TO_TIME})

SENSOR_DRIFT = Effect(
    id="sensor_drift",
    title="Sensor drift",
    summary="The reading drifts slowly, also at rest; the reference does not.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(shows_as=EffectSignature.WANDER),
    formulations=(
        Formulation(
            name="random_walk",
            equation="y = q + w, ẇ = r n, n white: w spreads as r √t",
            source="IEEE Std 952-1997, annex C",
            parameters=(
                EffectParameter(
                    "rate", "r, rms after one second", "q/√s", 0.0, 1000.0, 2.0, per="noise"
                ),
            ),
            acts=ReadingFunction(step=add_random_walk, states=1, random=True),
            traits=_TRAITS,
        ),
        Formulation(
            name="flicker",
            equation="y = q + w, spectrum of w: L²/f (one-sided) from 1 mHz to 250 Hz",
            source="Corsini and Saletti, IEEE Trans. Instrum. Meas. 37 (1988) 615–619",
            parameters=(
                EffectParameter(
                    "level", "L, rms per factor e of frequency", "q", 0.0, 1000.0, 2.0, per="noise"
                ),
            ),
            acts=ReadingFunction(step=add_flicker_noise, states=3 * POLE_COUNT + 2, random=True),
            prepare=_compute_cascade,
            traits=_TRAITS,
        ),
    ),
)
