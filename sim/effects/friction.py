"""Friction in guides and screw: a force against motion and its onset."""

from collections.abc import Iterator
from dataclasses import replace
from math import inf, pi, sqrt

import numpy as np

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Change,
    Effect,
    Force,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification, Retuning, View
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Axis

SPRINGS = 8
_INNER_SHARE = 1.0 / 60.0  # of the axis' period: the force is held for so long
_FREE_STEP_S = 5e-4  # where no spring sets a period
_BRISTLE_SHARE = 0.1  # of the period of the axis on its bristles, as far as
_FINER = 4.0  # times finer steps will do it


def coulomb(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the dry and viscous force that goes with the speed at the end of the step.

    ``|f| ≤ Fs`` brings the speed ``v + b f`` to zero where it can: the axis sticks. Else
    ``f = −F(v) sign v − D v`` by direction, with ``F = Fc + (Fs − Fc) exp(−(v/vs)²)``, is solved
    for the speed that it leaves: from below, so that an axis that breaks loose meets Fs first.

    p: Fc+, Fc−, Fs/Fc, vs, D+, D−.
    """
    forward = other > 0.0
    dry = p[0] if forward else p[1]
    viscous = p[4] if forward else p[5]
    speed = abs(other)
    most = dry * p[2]
    if speed <= b * most:
        return -other / b
    left = (speed - b * most) / (1.0 + b * viscous)
    if p[2] > 1.0:
        for _ in range(3):
            most = dry * (1.0 + (p[2] - 1.0) * np.exp(-((left / p[3]) ** 2)))
            left = (speed - b * most) / (1.0 + b * viscous)
    force = most + viscous * left
    return -force if forward else force


def lugre(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``f = −σ₀ z − σ₁(v) ż − D v, ż = v − |v| z / (zs g(v))``, solved for the end of the step.

    With ``g = 1 + (Fs/Fc − 1) exp(−(v/vs)²)`` and σ₁ of the speed found before, backward Euler
    for z leaves a quadratic for the speed with one root of the right sign, at any stiffness:
    ``(v (1 + b D) − v₀ − b σ₁ z₀/h) (1 + c v) + b (σ₀ + σ₁/h) (z₀ + h v) = 0``,
    ``c = h/(zs g)``. The damping of the bristles fades as ``σ₁/(1 + σ₁ |v|/(Fc g))``, which keeps
    the model passive at any speed.

    p: σ₀, zs, Fs/Fc − 1, vs, σ₁, σ₁/Fc, D; s: z.
    """
    forward = other - b * p[0] * s[0] >= 0.0
    free = other if forward else -other
    bent = s[0] if forward else -s[0]
    heavy = 1.0 + b * p[6]
    speed, bend, damping, rise = 0.0, bent, 0.0, 1.0 + p[2]
    for again in range(3):
        if again > 0:
            rise = 1.0 + p[2] * np.exp(-((speed / p[3]) ** 2)) if p[2] > 0.0 else 1.0
        damping = p[4] / (1.0 + p[5] * speed / rise) / h
        limit = h / (p[1] * rise)
        known = free + b * damping * bent
        square = limit * heavy
        linear = heavy - limit * known + b * (p[0] + damping) * h
        rest = max(free - b * p[0] * bent, 0.0)
        root = np.sqrt(linear * linear + 4.0 * square * rest)
        speed = 2.0 * rest / (linear + root) if linear > 0.0 else (root - linear) / (2.0 * square)
        bend = (bent + h * speed) / (1.0 + limit * speed)
    s[0] = bend if forward else -bend
    force = p[0] * bend + damping * (bend - bent) + p[6] * speed
    return -force if forward else force


def springs(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``f = −Σ kᵢ zᵢ − D v``; each spring follows the motion up to the deflection where it slips.

    Solved for the speed that the force leaves at the end of the step, ``v + b f``: the sum rises
    with the speed and is straight between the slips, so Newton's steps end exactly. A spring that
    the step resolves pulls by the mean of start and end, which conserves its energy; a stiffer one
    by the end, which damps.

    p: force of one spring, backward over forward, D, each kᵢ; s: each zᵢ.
    """
    heavy = 1.0 + b * p[2]
    speed = other
    for _ in range(4 * SPRINGS):
        total, slope = 0.0, 0.0
        for i in range(SPRINGS):
            stiff = b * p[3 + i] * h
            late = (0.5 + stiff) / (1.0 + stiff)
            before = p[3 + i] * s[i]
            pulled = before + p[3 + i] * h * speed
            if pulled > p[0]:
                pulled = p[0]
            elif pulled < -p[0] * p[1]:
                pulled = -p[0] * p[1]
            else:
                slope += late * p[3 + i] * h
            total += late * pulled + (1.0 - late) * before
        change = (speed * heavy - other + b * total) / (heavy + b * slope)
        speed -= change
        if abs(change) <= 1e-12 * abs(speed):
            break
    force = p[2] * speed
    for i in range(SPRINGS):
        stiff = b * p[3 + i] * h
        late = (0.5 + stiff) / (1.0 + stiff)
        before = p[3 + i] * s[i]
        pulled = min(max(before + p[3 + i] * h * speed, -p[0] * p[1]), p[0])
        s[i] = pulled / p[3 + i] if p[3 + i] > 0.0 else 0.0
        force += late * pulled + (1.0 - late) * before
    return -force


def dampened(values: Values, axis: Axis) -> Axis:
    """Return the axis with more damping, or less.

    Raises
    ------
    EffectError
        If the axis has no mass to be damped.
    """
    inertia = axis.inertia
    if inertia is None:
        raise EffectError(
            message(
                "engine", "friction: a static axis has no motion to damp; give it mass and damping"
            )
        )
    return replace(
        axis,
        mass=inertia.mass,
        damping=inertia.damping + values["viscous"],
        stiffness=inertia.stiffness or None,
        natural_frequency_hz=None,
        damping_ratio=None,
    )


def _bristles(values: Values, facts: Facts) -> tuple[float, ...]:
    """Return the numbers of :func:`lugre`; σ₁ is the damping ratio of the mass on its bristles."""
    dry, deflection = values["coulomb"], values["deflection"]
    stiffness = dry / deflection
    damping = 2.0 * values["bristle_damping"] * sqrt(stiffness * facts.mass)
    return (
        stiffness,
        deflection,
        values["static_ratio"] - 1.0,
        values["stribeck_speed"],
        damping,
        damping / dry if dry > 0.0 else 0.0,
        values["viscous"],
    )


def _springs(values: Values, facts: Facts) -> tuple[float, ...]:
    """Give all springs one force; the i-th of n slips at the deflection ``L ((i + 1)/n)^s``."""
    force = values["coulomb"] / SPRINGS
    slips = [values["deflection"] * ((i + 1) / SPRINGS) ** values["shape"] for i in range(SPRINGS)]
    return force, values["backward"], values["viscous"], *(force / slip for slip in slips)


def _inner_step(_values: Values, facts: Facts) -> float:
    return _INNER_SHARE / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_STEP_S


def _bristle_step(values: Values, facts: Facts) -> float:
    """Return a step that follows the axis on its bristles, if that asks for little more work."""
    return _following(values["coulomb"] / values["deflection"], facts)


def _springs_step(values: Values, facts: Facts) -> float:
    """Return a step that follows the axis on all its springs, if that asks for little more work."""
    return _following(sum(_springs(values, facts)[3:]), facts)


def _following(stiffness: float, facts: Facts) -> float:
    longest = _inner_step({}, facts)
    rate = sqrt(stiffness / facts.mass)
    period = 2.0 * pi / rate if rate > 0.0 else inf
    return min(longest, max(_BRISTLE_SHARE * period, longest / _FINER))


def _dry(name: str, meaning: str) -> Parameter:
    return Parameter(name, meaning, "N", 0.0, 100.0, 0.05, per="force")


def _viscous(name: str, meaning: str) -> Parameter:
    """Return a viscous friction that may remove the model's own, on a free axis."""
    return Parameter(name, meaning, "N s/q", 0.0, inf, 0.0, spare="free_damping")


_STATIC_RATIO = Parameter("static_ratio", "ratio of static to dry friction", "", 1.0, 3.0, 1.0)
_STRIBECK = Parameter("stribeck_speed", "speed where static friction fades", "q/s", 1e-6, 1.0, 1e-3)

_LADDER = (0.3, 3.0, 20.0)  # presets
_DEFLECTIONS = (0.3, 2.0)


def _slips(view: View) -> Iterator[Values]:
    dry = next(name for name in ("coulomb", "coulomb_forward", "viscous") if name in view.values)
    for share in (1.0,) if dry == "viscous" else _LADDER:
        start = {dry: view.values[dry] * share}
        if "shape" not in view.values:
            yield start
            continue
        for times in _DEFLECTIONS:
            yield {**start, "deflection": view.values["deflection"] * times}


def _damping(facts: Facts) -> Retuning | None:
    """Return that the damping of a free, force-driven axis is viscous friction."""
    free = facts.kind == "force" and facts.mass > 0.0 and facts.stiffness == 0.0
    return Retuning("viscous", {"viscous": 0.0}) if free else None


FRICTION = Effect(
    id="friction",
    title="Friction",
    summary="Spikes at reversals, stick-slip at low speed; damps ringing.",
    stage=Stage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    identification=Identification(starts=_slips, retunes=_damping, scout="springs"),
    kinship=Kinship(family=Family.LOST_MOTION, brings_along={Family.RESONANCE: 0.25}),
    formulations=(
        Formulation(
            name="stribeck",
            equation="f = −(Fc + (Fs − Fc) exp(−(v/vs)²)) sign v − D v, each by direction",
            source="Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138",
            parameters=(
                _dry("coulomb_forward", "dry friction forward"),
                _dry("coulomb_backward", "dry friction backward"),
                _STATIC_RATIO,
                _STRIBECK,
                _viscous("viscous_forward", "viscous friction forward"),
                _viscous("viscous_backward", "viscous friction backward"),
            ),
            acts=Force(step=coulomb),
            inner_step_s=_inner_step,
            traits=frozenset({Trait.DISSIPATIVE}),
        ),
        Formulation(
            name="lugre",
            equation="f = −σ₀ z − σ₁ ż − D v, ż = v − σ₀ |v| z / (Fc + (Fs − Fc) exp(−(v/vs)²))",
            source="Canudas de Wit, Olsson, Åström, Lischinsky, IEEE TAC 40 (1995) 419–425",
            parameters=(
                _dry("coulomb", "dry friction"),
                Parameter(
                    "deflection",
                    "Fc/σ₀, deflection of the bristles",
                    "q",
                    1e-8,
                    1e-2,
                    1e-5,
                    per="span",
                ),
                Parameter("bristle_damping", "damping ratio of the bristles", "", 0.0, 2.0, 0.5),
                _STATIC_RATIO,
                _STRIBECK,
                _viscous("viscous", "viscous friction"),
            ),
            acts=Force(step=lugre, states=1),
            prepare=_bristles,
            inner_step_s=_bristle_step,
            traits=frozenset({Trait.DISSIPATIVE}),
        ),
        Formulation(
            name="springs",
            equation="f = −Σ kᵢ zᵢ − D v, |kᵢ zᵢ| ≤ Fc/n, slipping at L (i/n)^s, i = 1…n = 8",
            source="Iwan, J. Applied Mechanics 33 (1966) 893–900",
            parameters=(
                _dry("coulomb", "dry friction forward"),
                Parameter(
                    "backward", "ratio of dry friction, backward to forward", "", 0.3, 3.0, 1.0
                ),
                Parameter(
                    "deflection",
                    "L, deflection where all springs slip",
                    "q",
                    1e-8,
                    1e-2,
                    3e-5,
                    per="span",
                ),
                Parameter("shape", "s, 0: all springs slip together", "", 0.0, 4.0, 1.0),
                _viscous("viscous", "viscous friction"),
            ),
            acts=Force(step=springs, states=SPRINGS),
            prepare=_springs,
            inner_step_s=_springs_step,
            traits=frozenset({Trait.DISSIPATIVE}),
        ),
        Formulation(
            name="viscous",
            equation="f = −D v, the damping of an axis that nothing holds being D too",
            source="Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138",
            parameters=(_viscous("viscous", "viscous friction"),),
            acts=Change(change=dampened),
            traits=frozenset({Trait.LINEAR, Trait.MEMORYLESS}),
            kinds=frozenset({"force"}),
        ),
    ),
)
