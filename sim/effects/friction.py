"""Friction in guides and screw: a force that opposes motion and the start of motion."""

from collections.abc import Iterator
from dataclasses import replace
from math import inf, pi, sqrt

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    AxisChange,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    ForceFunction,
    Formulation,
    Values,
)
from rotemina.sim.effects.identification import FitView, IdentificationHints, RetunedParameters
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.errors import EffectError
from rotemina.sim.robot import Axis

SPRING_COUNT = 8
# Inner step in periods of the axis, during which the force is held.
_INNER_STEP_PERIODS = 1.0 / 60.0
# Inner step of an axis without stiffness, which has no period.
_FREE_AXIS_STEP_S = 5e-4
# Inner step in periods of the axis on its bristles or springs.
_BRISTLE_STEP_PERIODS = 0.1
# Inner steps are refined at most by this factor to follow the bristles or springs.
_MAX_REFINEMENT_RATIO = 4.0


def compute_stribeck_force(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the dry and viscous friction at the speed at the end of the step.

    A force ``|f| ≤ Fs`` brings the speed ``v + b f`` to zero if it can: the axis sticks.
    Otherwise ``f = −F(v) sign v − D v``, which depends on the direction, with
    ``F = Fc + (Fs − Fc) exp(−(v/vs)²)``, is solved for the speed after the step. The solution
    starts from low speed, so that an axis that breaks loose meets Fs first.

    p: Fc+, Fc−, Fs/Fc, vs, D+, D−.
    """
    forward = other > 0.0
    dry = p[0] if forward else p[1]
    viscous = p[4] if forward else p[5]
    speed = abs(other)
    limit = dry * p[2]
    if speed <= b * limit:
        return -other / b
    speed_after = (speed - b * limit) / (1.0 + b * viscous)
    if p[2] > 1.0:
        for _ in range(3):
            limit = dry * (1.0 + (p[2] - 1.0) * np.exp(-((speed_after / p[3]) ** 2)))
            speed_after = (speed - b * limit) / (1.0 + b * viscous)
    force = limit + viscous * speed_after
    return -force if forward else force


def compute_lugre_force(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return ``f = −σ₀ z − σ₁(v) ż − D v, ż = v − |v| z / (zs g(v))`` at the end of the step.

    With ``g = 1 + (Fs/Fc − 1) exp(−(v/vs)²)``, and σ₁ at the previous iterate of the speed,
    backward Euler for z leaves a quadratic equation for the speed. It has one root of the right
    sign, at any stiffness:
    ``(v (1 + b D) − v₀ − b σ₁ z₀/h) (1 + c v) + b (σ₀ + σ₁/h) (z₀ + h v) = 0``, ``c = h/(zs g)``.
    The damping of the bristles fades as ``σ₁/(1 + σ₁ |v|/(Fc g))``, which keeps the model passive
    at any speed.

    p: σ₀, zs, Fs/Fc − 1, vs, σ₁, σ₁/Fc, D; s: z.
    """
    forward = other - b * p[0] * s[0] >= 0.0
    free_speed = other if forward else -other
    bend_before = s[0] if forward else -s[0]
    viscous_factor = 1.0 + b * p[6]
    speed, bend_after, damping, stribeck_factor = 0.0, bend_before, 0.0, 1.0 + p[2]
    for iteration in range(3):
        if iteration > 0:
            stribeck_factor = 1.0 + p[2] * np.exp(-((speed / p[3]) ** 2)) if p[2] > 0.0 else 1.0
        damping = p[4] / (1.0 + p[5] * speed / stribeck_factor) / h
        c = h / (p[1] * stribeck_factor)
        explicit_speed = free_speed + b * damping * bend_before
        quadratic = c * viscous_factor
        linear = viscous_factor - c * explicit_speed + b * (p[0] + damping) * h
        constant = max(free_speed - b * p[0] * bend_before, 0.0)
        root = np.sqrt(linear * linear + 4.0 * quadratic * constant)
        speed = (
            2.0 * constant / (linear + root)
            if linear > 0.0
            else (root - linear) / (2.0 * quadratic)
        )
        bend_after = (bend_before + h * speed) / (1.0 + c * speed)
    s[0] = bend_after if forward else -bend_after
    force = p[0] * bend_after + damping * (bend_after - bend_before) + p[6] * speed
    return -force if forward else force


def compute_springs_force(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return ``f = −Σ kᵢ zᵢ − D v``; a spring follows the motion up to its slip deflection.

    The equation is solved for the speed at the end of the step, ``v + b f``. The sum increases with
    the speed and is linear between the slips, so Newton's method ends exactly. A spring that the
    step resolves acts by the mean of its force at start and end, which conserves its energy. A
    stiffer one acts by its force at the end, which damps.

    p: force of one spring, backward over forward, D, each kᵢ; s: each zᵢ.
    """
    viscous_factor = 1.0 + b * p[2]
    speed = other
    for _ in range(4 * SPRING_COUNT):
        total, slope = 0.0, 0.0
        for i in range(SPRING_COUNT):
            stiffness_ratio = b * p[3 + i] * h
            end_weight = (0.5 + stiffness_ratio) / (1.0 + stiffness_ratio)
            start_force = p[3 + i] * s[i]
            end_force = start_force + p[3 + i] * h * speed
            if end_force > p[0]:
                end_force = p[0]
            elif end_force < -p[0] * p[1]:
                end_force = -p[0] * p[1]
            else:
                slope += end_weight * p[3 + i] * h
            total += end_weight * end_force + (1.0 - end_weight) * start_force
        change = (speed * viscous_factor - other + b * total) / (viscous_factor + b * slope)
        speed -= change
        if abs(change) <= 1e-12 * abs(speed):
            break
    force = p[2] * speed
    for i in range(SPRING_COUNT):
        stiffness_ratio = b * p[3 + i] * h
        end_weight = (0.5 + stiffness_ratio) / (1.0 + stiffness_ratio)
        start_force = p[3 + i] * s[i]
        end_force = min(max(start_force + p[3 + i] * h * speed, -p[0] * p[1]), p[0])
        s[i] = end_force / p[3 + i] if p[3 + i] > 0.0 else 0.0
        force += end_weight * end_force + (1.0 - end_weight) * start_force
    return -force


def with_damping(values: Values, axis: Axis) -> Axis:
    """Return the axis with the viscous friction added to its damping.

    Raises
    ------
    EffectError
        If the axis has no mass to be damped.
    """
    inertia = axis.inertia
    if inertia is None:
        raise EffectError("friction: a static axis has no motion to damp; give it mass and damping")
    return replace(
        axis,
        mass=inertia.mass,
        damping=inertia.damping + values["viscous"],
        stiffness=inertia.stiffness or None,
        natural_frequency_hz=None,
        damping_ratio=None,
    )


def _compute_bristle_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p of :func:`compute_lugre_force`.

    σ₁ is set by the damping ratio of the mass on its bristles.
    """
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


def _compute_spring_numbers(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p: equal forces; spring i of n slips at the deflection ``L ((i + 1)/n)^s``."""
    force = values["coulomb"] / SPRING_COUNT
    slips = [
        values["deflection"] * ((i + 1) / SPRING_COUNT) ** values["shape"]
        for i in range(SPRING_COUNT)
    ]
    return force, values["backward"], values["viscous"], *(force / slip for slip in slips)


def _compute_inner_step(_values: Values, facts: AxisProperties) -> float:
    return (
        _INNER_STEP_PERIODS / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_AXIS_STEP_S
    )


def _compute_bristle_step(values: Values, facts: AxisProperties) -> float:
    return _refine_step(values["coulomb"] / values["deflection"], facts)


def _compute_springs_step(values: Values, facts: AxisProperties) -> float:
    return _refine_step(sum(_compute_spring_numbers(values, facts)[3:]), facts)


def _refine_step(stiffness: float, facts: AxisProperties) -> float:
    longest_step_s = _compute_inner_step({}, facts)
    rate = sqrt(stiffness / facts.mass)
    period = 2.0 * pi / rate if rate > 0.0 else inf
    return min(
        longest_step_s, max(_BRISTLE_STEP_PERIODS * period, longest_step_s / _MAX_REFINEMENT_RATIO)
    )


def _make_dry(name: str, meaning: str) -> EffectParameter:
    return EffectParameter(name, meaning, "N", 0.0, 100.0, 0.05, per="force")


def _make_viscous(name: str, meaning: str) -> EffectParameter:
    """Return a viscous friction parameter; if negative, it reduces the damping of a free axis."""
    return EffectParameter(name, meaning, "N s/q", 0.0, inf, 0.0, spare="free_damping")


_STATIC_RATIO = EffectParameter(
    "static_ratio", "ratio of static to dry friction", "", 1.0, 3.0, 1.0
)
_STRIBECK = EffectParameter(
    "stribeck_speed", "speed where static friction fades", "q/s", 1e-6, 1.0, 1e-3
)

# Multiples of the preset from which a fit starts.
_FORCE_FACTORS = (0.3, 3.0, 20.0)
_DEFLECTION_FACTORS = (0.3, 2.0)


def _start_from_sizes(view: FitView) -> Iterator[Values]:
    friction_name = next(
        name for name in ("coulomb", "coulomb_forward", "viscous") if name in view.values
    )
    for factor in (1.0,) if friction_name == "viscous" else _FORCE_FACTORS:
        start = {friction_name: view.values[friction_name] * factor}
        if "shape" not in view.values:
            yield start
            continue
        for deflection_factor in _DEFLECTION_FACTORS:
            yield {**start, "deflection": view.values["deflection"] * deflection_factor}


def _find_retuning(facts: AxisProperties) -> RetunedParameters | None:
    """Return the re-tuned viscous friction of a free, force-driven axis.

    The damping of its model is the same parameter.
    """
    is_free = facts.kind == "force" and facts.mass > 0.0 and facts.stiffness == 0.0
    return RetunedParameters("viscous", {"viscous": 0.0}) if is_free else None


FRICTION = Effect(
    id="friction",
    title="Friction",
    summary="Spikes at reversals, stick-slip at low speed; damps ringing.",
    stage=EffectStage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    identification=IdentificationHints(
        starts=_start_from_sizes, retunes=_find_retuning, scout="springs"
    ),
    kinship=EffectRelations(
        family=EffectFamily.LOST_MOTION, brings_along={EffectFamily.RESONANCE: 0.25}
    ),
    formulations=(
        Formulation(
            name="stribeck",
            equation="f = −(Fc + (Fs − Fc) exp(−(v/vs)²)) sign v − D v, each by direction",
            source="Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138",
            parameters=(
                _make_dry("coulomb_forward", "dry friction forward"),
                _make_dry("coulomb_backward", "dry friction backward"),
                _STATIC_RATIO,
                _STRIBECK,
                _make_viscous("viscous_forward", "viscous friction forward"),
                _make_viscous("viscous_backward", "viscous friction backward"),
            ),
            acts=ForceFunction(step=compute_stribeck_force),
            inner_step_s=_compute_inner_step,
            traits=frozenset({EffectTrait.DISSIPATIVE}),
        ),
        Formulation(
            name="lugre",
            equation="f = −σ₀ z − σ₁ ż − D v, ż = v − σ₀ |v| z / (Fc + (Fs − Fc) exp(−(v/vs)²))",
            source="Canudas de Wit, Olsson, Åström, Lischinsky, IEEE TAC 40 (1995) 419–425",
            parameters=(
                _make_dry("coulomb", "dry friction"),
                EffectParameter(
                    "deflection",
                    "Fc/σ₀, deflection of the bristles",
                    "q",
                    1e-8,
                    1e-2,
                    1e-5,
                    per="span",
                ),
                EffectParameter(
                    "bristle_damping", "damping ratio of the bristles", "", 0.0, 2.0, 0.5
                ),
                _STATIC_RATIO,
                _STRIBECK,
                _make_viscous("viscous", "viscous friction"),
            ),
            acts=ForceFunction(step=compute_lugre_force, states=1),
            prepare=_compute_bristle_numbers,
            inner_step_s=_compute_bristle_step,
            traits=frozenset({EffectTrait.DISSIPATIVE}),
        ),
        Formulation(
            name="springs",
            equation="f = −Σ kᵢ zᵢ − D v, |kᵢ zᵢ| ≤ Fc/n, slipping at L (i/n)^s, i = 1…n = 8",
            source="Iwan, J. Applied Mechanics 33 (1966) 893–900",
            parameters=(
                _make_dry("coulomb", "dry friction forward"),
                EffectParameter(
                    "backward", "ratio of dry friction, backward to forward", "", 0.3, 3.0, 1.0
                ),
                EffectParameter(
                    "deflection",
                    "L, deflection where all springs slip",
                    "q",
                    1e-8,
                    1e-2,
                    3e-5,
                    per="span",
                ),
                EffectParameter("shape", "s, 0: all springs slip together", "", 0.0, 4.0, 1.0),
                _make_viscous("viscous", "viscous friction"),
            ),
            acts=ForceFunction(step=compute_springs_force, states=SPRING_COUNT),
            prepare=_compute_spring_numbers,
            inner_step_s=_compute_springs_step,
            traits=frozenset({EffectTrait.DISSIPATIVE}),
        ),
        Formulation(
            name="viscous",
            equation="f = −D v, the damping of an axis that nothing holds being D too",
            source="Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083–1138",
            parameters=(_make_viscous("viscous", "viscous friction"),),
            acts=AxisChange(change=with_damping),
            traits=frozenset({EffectTrait.LINEAR, EffectTrait.MEMORYLESS}),
            kinds=frozenset({"force"}),
        ),
    ),
)
