"""Friction in guides and screw: a force against motion, and against its beginning."""

from math import inf

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Effect,
    Force,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)

_INNER_SHARE = 1.0 / 60.0  # of the axis' period: the force is held for so long
_FREE_STEP_S = 1e-4  # where no spring sets a period


def coulomb(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the dry and viscous force that goes with the speed at the end of the step.

    ``|f| ≤ F`` brings the speed ``v + b f`` to zero where it can: the axis sticks. Else
    ``f = −F(v) sign v − D v`` by direction, with ``F = Fc + (Fs − Fc) exp(−(v/vs)²)``, solved
    for the speed that it leaves (F at the speed before). It never feeds energy in.

    p: Fc+, Fc−, Fs/Fc, vs, D+, D−.
    """
    forward = other > 0.0
    dry = p[0] if forward else p[1]
    viscous = p[4] if forward else p[5]
    speed = abs(other)
    dry *= 1.0 + (p[2] - 1.0) * np.exp(-((speed / p[3]) ** 2))
    if speed <= b * dry:
        return -other / b
    left = (speed - b * dry) / (1.0 + b * viscous)
    force = dry + viscous * left
    return -force if forward else force


def _inner_step(_values: Values, facts: Facts) -> float:
    return _INNER_SHARE / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_STEP_S


def _dry(name: str, meaning: str) -> Parameter:
    return Parameter(name, meaning, "N", 0.0, 1.0, 0.05, per="force")


FRICTION = Effect(
    id="friction",
    title="Friction",
    summary="Spikes at reversals, stick-slip at low speed; damps ringing.",
    stage=Stage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    formulations=(
        Formulation(
            name="stribeck",
            equation="f = −(Fc + (Fs − Fc) exp(−(v/vs)²)) sign v − D v, each by direction",
            source="Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138",
            parameters=(
                _dry("coulomb_forward", "dry friction forward"),
                _dry("coulomb_backward", "dry friction backward"),
                Parameter("static_ratio", "of static over dry friction", "", 1.0, 3.0, 1.0),
                Parameter("stribeck_speed", "where static friction fades", "q/s", 1e-6, 1.0, 1e-3),
                Parameter("viscous_forward", "viscous friction forward", "N s/q", 0.0, inf, 0.0),
                Parameter("viscous_backward", "viscous friction backward", "N s/q", 0.0, inf, 0.0),
            ),
            acts=Force(step=coulomb),
            inner_step_s=_inner_step,
            traits=frozenset({Trait.DISSIPATIVE}),
        ),
    ),
)
