"""Resonance whose frequency or damping differs from that of the model."""

from dataclasses import replace

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    AxisChange,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    Values,
)
from rotemina.sim.effects.identification import IdentificationHints, RetunedParameters
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.errors import EffectError
from rotemina.sim.robot import Axis


def detune_axis(values: Values, axis: Axis) -> Axis:
    """Return the axis with another mass and damping, which keep its static gain.

    With ``ω' = (1 + δ) ω`` and ``ζ' = (1 + ε) ζ`` at the same stiffness:
    ``M' = M / (1 + δ)²``, ``D' = D (1 + ε) / (1 + δ)``.

    Raises
    ------
    EffectError
        If the axis has no stiffness and therefore no resonance.
    """
    inertia = axis.inertia
    if inertia is None or inertia.stiffness == 0.0:
        raise EffectError(
            "resonance_mismatch: nothing holds this axis, so it has no resonance; give "
            "it mass, damping and stiffness, or remove the effect"
        )
    frequency_ratio = 1.0 + values["frequency_error"]
    return replace(
        axis,
        mass=inertia.mass / frequency_ratio**2,
        damping=inertia.damping * (1.0 + values["damping_error"]) / frequency_ratio,
        stiffness=inertia.stiffness,
        natural_frequency_hz=None,
        damping_ratio=None,
    )


def _find_retuning(facts: AxisProperties) -> RetunedParameters | None:
    """Return the re-tuned parameters: mass and damping, of a piezo or stepper with stiffness.

    An axis that is driven by a force has a gain and friction instead.
    """
    has_resonance = facts.stiffness > 0.0 and facts.kind != "force"
    return (
        RetunedParameters(None, {"frequency_error": 0.0, "damping_error": 0.0})
        if has_resonance
        else None
    )


RESONANCE_MISMATCH = Effect(
    id="resonance_mismatch",
    title="Resonance mismatch",
    summary="Wrong frequency or damping: visible only near the resonance.",
    stage=EffectStage.MECHANICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        retunes=_find_retuning,
        domain={"frequency_error": (-0.3, 0.3), "damping_error": (-0.8, 4.0)},
    ),
    kinship=EffectRelations(family=EffectFamily.RESONANCE),
    formulations=(
        Formulation(
            name="detuned",
            equation="ω' = (1 + δ) ω, ζ' = (1 + ε) ζ, the static gain stays",
            source="Preumont, Vibration Control of Active Structures, 4th ed. (2018), ch. 2",
            parameters=(
                EffectParameter(
                    "frequency_error", "δ, error of the natural frequency", "", -0.5, 0.5, 0.05
                ),
                EffectParameter(
                    "damping_error", "ε, error of the damping ratio", "", -0.9, 9.0, 0.0
                ),
            ),
            acts=AxisChange(change=detune_axis),
            traits=frozenset({EffectTrait.LINEAR, EffectTrait.TRANSIENT, EffectTrait.MEMORYLESS}),
        ),
    ),
)
