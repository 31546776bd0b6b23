"""A resonance whose frequency or sharpness differs from the model's."""

from dataclasses import replace

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Change,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification, Retuning
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Axis


def detuned(values: Values, axis: Axis) -> Axis:
    """Return the axis with another mass and damping, so that its static gain stays.

    With ``ω' = (1 + δ) ω`` and ``ζ' = (1 + ε) ζ`` at the same stiffness:
    ``M' = M / (1 + δ)²``, ``D' = D (1 + ε) / (1 + δ)``.
    """
    inertia = axis.inertia
    if inertia is None or inertia.stiffness == 0.0:
        raise EffectError(
            message(
                "engine",
                "resonance_mismatch: nothing holds this axis, so it has no resonance; give "
                "it mass, damping and stiffness, or remove the effect",
            )
        )
    faster = 1.0 + values["frequency_error"]
    return replace(
        axis,
        mass=inertia.mass / faster**2,
        damping=inertia.damping * (1.0 + values["damping_error"]) / faster,
        stiffness=inertia.stiffness,
        natural_frequency_hz=None,
        damping_ratio=None,
    )


def _own(facts: Facts) -> Retuning | None:
    """Return that mass and damping are the axis' own where a spring holds what follows a position.

    What a force moves has a gain and friction instead.
    """
    held = facts.stiffness > 0.0 and facts.kind != "force"
    return Retuning(None, {"frequency_error": 0.0, "damping_error": 0.0}) if held else None


RESONANCE_MISMATCH = Effect(
    id="resonance_mismatch",
    title="Resonance mismatch",
    summary="Wrong frequency or damping: visible only near the resonance.",
    stage=Stage.MECHANICS,
    kinds=EVERY_KIND,
    identification=Identification(
        retunes=_own, domain={"frequency_error": (-0.3, 0.3), "damping_error": (-0.8, 4.0)}
    ),
    kinship=Kinship(family=Family.RESONANCE),
    formulations=(
        Formulation(
            name="detuned",
            equation="ω' = (1 + δ) ω, ζ' = (1 + ε) ζ, the static gain stays",
            source="Preumont, Vibration Control of Active Structures, 4th ed. (2018), ch. 2",
            parameters=(
                Parameter(
                    "frequency_error", "δ, error of the natural frequency", "", -0.5, 0.5, 0.05
                ),
                Parameter("damping_error", "ε, error of the damping ratio", "", -0.9, 9.0, 0.0),
            ),
            acts=Change(change=detuned),
            traits=frozenset({Trait.LINEAR, Trait.TRANSIENT, Trait.MEMORYLESS}),
        ),
    ),
)
