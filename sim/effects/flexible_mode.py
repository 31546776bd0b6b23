"""A further vibration mode that the axis' nominal model lacks."""

import numpy as np

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    LinearPart,
    Parameter,
    Part,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.modes import modal_parameters, modal_part
from rotemina.sim.effects.starts import modes
from rotemina.sim.messages import message

FREQUENCY = Parameter("frequency", "of the mode", "Hz", 0.02, 50.0, 1.7, per="pace_hz")
DAMPING = Parameter("damping_ratio", "of the mode", "", 1e-4, 2.0, 0.03)


def _oscillator(values: Values) -> tuple[float, float]:
    rate = 2.0 * np.pi * values["frequency"]
    return rate, 2.0 * values["damping_ratio"] * rate


def _appendage(values: Values, facts: Facts) -> LinearPart:
    """Hang a mass on a spring on the axis: ``μ M ξ̈ = −f``, f the force on the axis."""
    if facts.mass == 0.0:
        raise EffectError(
            message(
                "engine",
                "flexible_mode: formulation 'appendage' pulls on the mass of an axis, but "
                "this axis is static; give it mass, damping and stiffness, or choose another "
                "formulation",
            )
        )
    rate, loss = _oscillator(values)
    mass = values["mass_ratio"] * facts.mass
    return LinearPart(
        a=np.array([[0.0, 1.0], [-(rate**2), -loss]]),
        b=np.array([[0.0, 0.0, 0.0], [rate**2, loss, 0.0]]),
        output=np.zeros(2),
        force=mass * np.array([rate**2, loss]),
        reaction=(-mass * rate**2, -mass * loss),
    )


def _parallel(values: Values, facts: Facts) -> LinearPart:
    """Give the input a second path to the position, with a mode of its own.

    A free axis has no static motion to share: the mode is added to it, and r is its modal mass over
    the axis' (``z̈ + 2ζω ż + ω² z = gain/M · u``).
    """
    rate, loss = _oscillator(values)
    share = values["share"]
    free = facts.stiffness == 0.0 and facts.mass > 0.0
    drive = rate**2
    if facts.kind == "force":
        drive = facts.gain / facts.mass if free else rate**2 * facts.gain / facts.stiffness
    return LinearPart(
        a=np.array([[0.0, 1.0], [-(rate**2), -loss]]),
        b=np.array([[0.0, 0.0, 0.0], [0.0, 0.0, drive]]),
        output=np.array([share, 0.0]),
        share=0.0 if free else share,
    )


def _series(values: Values, _facts: Facts) -> LinearPart:
    """Put a flexible link between the axis and the point that is seen."""
    rate, loss = _oscillator(values)
    share = values["share"]
    return LinearPart(
        a=np.array([[0.0, 1.0], [-(rate**2), -loss]]),
        b=np.array([[0.0, 0.0, 0.0], [rate**2, 0.0, 0.0]]),
        output=np.array([share, 0.0]),
        share=share,
    )


_LINEAR = frozenset({Trait.LINEAR, Trait.TRANSIENT, Trait.MEMORYLESS})

FLEXIBLE_MODE = Effect(
    id="flexible_mode",
    title="Flexible mode",
    summary="A peak or a dip where the model has none.",
    stage=Stage.MECHANICS,
    kinds=EVERY_KIND,
    identification=Identification(
        starts=modes,
        domain={"damping_ratio": (1e-4, 0.35)},  # a lag, beyond
    ),
    kinship=Kinship(brings_along={Family.RESONANCE: 1.0}),
    formulations=(
        Formulation(
            name="parallel",
            equation="y = (1 − r) q + r z, z̈ + 2ζω ż + ω² z = ω² U",
            source="Preumont, Vibration Control of Active Structures, 4th ed. (2018), ch. 2",
            parameters=(
                FREQUENCY,
                DAMPING,
                Parameter(
                    "share", "r, share of the static motion along this path", "", -2.0, 2.0, 0.05
                ),
            ),
            acts=Part(part=_parallel),
            traits=_LINEAR,
        ),
        Formulation(
            name="appendage",
            equation="ξ̈ = ω² (q − ξ) + 2ζω (q̇ − ξ̇), force on the axis −μ M ξ̈",
            source="Den Hartog, Mechanical Vibrations, 4th ed. (1956), ch. 3",
            parameters=(
                FREQUENCY,
                DAMPING,
                Parameter(
                    "mass_ratio", "μ, ratio of its mass to the axis' mass", "", 0.0, 2.0, 0.05
                ),
            ),
            acts=Part(part=_appendage),
            traits=_LINEAR,
        ),
        Formulation(
            name="series",
            equation="y = (1 − r) q + r z, z̈ + 2ζω ż + ω² z = ω² q",
            source="Preumont, Vibration Control of Active Structures, 4th ed. (2018), ch. 2",
            parameters=(
                FREQUENCY,
                DAMPING,
                Parameter(
                    "share", "r, share of the motion seen through the link", "", -2.0, 2.0, 0.3
                ),
            ),
            acts=Part(part=_series),
            traits=_LINEAR,
        ),
        Formulation(
            name="modes",
            equation="y = q + Σ (aₖ zₖ + bₖ żₖ/ωₖ), z̈ₖ + 2ζₖωₖ żₖ + ωₖ² zₖ = ωₖ² U",
            source="Gustavsen and Semlyen, IEEE Trans. Power Delivery 14 (1999) 1052-1061",
            parameters=modal_parameters(""),
            acts=Part(part=modal_part),
            traits=frozenset({Trait.LINEAR, Trait.MEMORYLESS}),
            kinds=frozenset({"piezo", "stepper"}),
            by_spectra=True,
        ),
    ),
)
