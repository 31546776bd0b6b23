"""A sensor whose zero wanders while nothing moves."""

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
from rotemina.sim.effects.identification import Identification, Sign

POLES = 10
_SLOWEST_HZ = 1e-3
_SAME = 1e-9  # relative difference of steps up to which they differ by rounding
_DECADES_APART = 0.6  # so that the slope ripples by less than 2 %; the last pole is at 250 Hz


def random_walk(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + w``, ``dw = r √h a``. p: r; s: w."""
    s[0] += p[0] * np.sqrt(h) * a
    return x + s[0]


def flicker(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + Σ wᵢ``, ``ẇᵢ = −pᵢ wᵢ + rᵢ n``, all driven by the same white noise n.

    n is held during h, so components faster than the samples do not alias. p: pᵢ, then rᵢ; s: wᵢ,
    then h and r₀ of the last call, then the decay of each in a step of h, and its change per
    variate.
    """
    if h <= 0.0:
        y = x
        for i in range(POLES):
            y += s[i]
        return y
    if abs(h - s[POLES]) > _SAME * h or p[POLES] != s[POLES + 1]:
        s[POLES], s[POLES + 1] = h, p[POLES]
        for i in range(POLES):
            s[POLES + 2 + i] = np.exp(-p[i] * h)
            s[2 * POLES + 2 + i] = -np.expm1(-p[i] * h) * p[POLES + i] / (p[i] * np.sqrt(h))
    y = x
    for i in range(POLES):
        s[i] = s[POLES + 2 + i] * s[i] + s[2 * POLES + 2 + i] * a
        y += s[i]
    return y


def _cascade(values: Values, _facts: Facts) -> tuple[float, ...]:
    """Return poles and residues of ``H = k Π (s + zⱼ) / Π (s + pᵢ)``, which falls as 1/√f.

    The poles lie evenly on a logarithmic scale, each zero half way between two of them. k sets
    ``|H|² = 2 L²/f`` (one-sided) half way along.
    """
    poles = 2.0 * np.pi * _SLOWEST_HZ * 10.0 ** (_DECADES_APART * np.arange(POLES))
    zeros = np.sqrt(poles[1:] * poles[:-1])
    residues = [
        float(np.prod(zeros - pole) / np.prod(np.delete(poles, i) - pole))
        for i, pole in enumerate(poles)
    ]
    middle = float(np.sqrt(poles[0] * poles[-1]))
    size = abs(np.sum(np.array(residues) / (1j * middle + poles)))
    level = values["level"] / np.sqrt(2.0 * middle / (2.0 * np.pi))
    return (*poles.tolist(), *(residue * level / size for residue in residues))


_TRAITS = frozenset({Trait.RANDOM, Trait.READING_ONLY, Trait.LOCKED_TO_TIME})

SENSOR_DRIFT = Effect(
    id="sensor_drift",
    title="Sensor drift",
    summary="The reading drifts slowly, also at rest; the reference does not.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    identification=Identification(shows_as=Sign.WANDER),
    formulations=(
        Formulation(
            name="random_walk",
            equation="y = q + w, ẇ = r n, n white: w spreads as r √t",
            source="IEEE Std 952-1997, annex C",
            parameters=(
                Parameter("rate", "r, rms after one second", "q/√s", 0.0, 1000.0, 2.0, per="noise"),
            ),
            acts=Reading(step=random_walk, states=1, random=True),
            traits=_TRAITS,
        ),
        Formulation(
            name="flicker",
            equation="y = q + w, spectrum of w: L²/f (one-sided) from 1 mHz to 250 Hz",
            source="Corsini and Saletti, IEEE Trans. Instrum. Meas. 37 (1988) 615–619",
            parameters=(
                Parameter(
                    "level", "L, rms per factor e of frequency", "q", 0.0, 1000.0, 2.0, per="noise"
                ),
            ),
            acts=Reading(step=flicker, states=3 * POLES + 2, random=True),
            prepare=_cascade,
            traits=_TRAITS,
        ),
    ),
)
