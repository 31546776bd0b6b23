"""Further vibration mode that the nominal model of the axis lacks."""

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    AddedStates,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    LinearPart,
    Values,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.modes import make_modal_parameters, make_modal_part
from rotemina.sim.effects.starts import start_from_modes
from rotemina.sim.errors import EffectError

FREQUENCY = EffectParameter("frequency", "of the mode", "Hz", 0.02, 50.0, 1.7, per="pace_hz")
DAMPING = EffectParameter("damping_ratio", "of the mode", "", 1e-4, 2.0, 0.03)


def _compute_oscillator(values: Values) -> tuple[float, float]:
    omega = 2.0 * np.pi * values["frequency"]
    return omega, 2.0 * values["damping_ratio"] * omega


def _make_appendage(values: Values, facts: AxisProperties) -> LinearPart:
    """Attach a mass to the axis by a spring: ``μ M ξ̈ = −f``, with f the force on the axis."""
    if facts.mass == 0.0:
        raise EffectError(
            "flexible_mode: formulation 'appendage' pulls on the mass of an axis, but "
            "this axis is static; give it mass, damping and stiffness, or choose another "
            "formulation"
        )
    omega, damping = _compute_oscillator(values)
    mass = values["mass_ratio"] * facts.mass
    return LinearPart(
        a=np.array([[0.0, 1.0], [-(omega**2), -damping]]),
        b=np.array([[0.0, 0.0, 0.0], [omega**2, damping, 0.0]]),
        output=np.zeros(2),
        force=mass * np.array([omega**2, damping]),
        reaction=(-mass * omega**2, -mass * damping),
    )


def _make_parallel_path(values: Values, facts: AxisProperties) -> LinearPart:
    """Add a second path from the input to the position, with its own mode.

    A free axis has no static motion to share. Its mode is added to the motion, and r is the modal
    mass over that of the axis (``z̈ + 2ζω ż + ω² z = gain/M · u``).
    """
    omega, damping = _compute_oscillator(values)
    share = values["share"]
    is_free = facts.stiffness == 0.0 and facts.mass > 0.0
    drive_gain = omega**2
    if facts.kind == "force":
        drive_gain = facts.gain / facts.mass if is_free else omega**2 * facts.gain / facts.stiffness
    return LinearPart(
        a=np.array([[0.0, 1.0], [-(omega**2), -damping]]),
        b=np.array([[0.0, 0.0, 0.0], [0.0, 0.0, drive_gain]]),
        output=np.array([share, 0.0]),
        share=0.0 if is_free else share,
    )


def _make_series_link(values: Values, _facts: AxisProperties) -> LinearPart:
    omega, damping = _compute_oscillator(values)
    share = values["share"]
    return LinearPart(
        a=np.array([[0.0, 1.0], [-(omega**2), -damping]]),
        b=np.array([[0.0, 0.0, 0.0], [omega**2, 0.0, 0.0]]),
        output=np.array([share, 0.0]),
        share=share,
    )


_LINEAR_TRAITS = frozenset({EffectTrait.LINEAR, EffectTrait.TRANSIENT, EffectTrait.MEMORYLESS})

FLEXIBLE_MODE = Effect(
    id="flexible_mode",
    title="Flexible mode",
    summary="A peak or a dip where the model has none.",
    stage=EffectStage.MECHANICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=start_from_modes,
        # With more damping it would be a lag.
        domain={"damping_ratio": (1e-4, 0.35)},
    ),
    kinship=EffectRelations(brings_along={EffectFamily.RESONANCE: 1.0}),
    formulations=(
        Formulation(
            name="parallel",
            equation="y = (1 − r) q + r z, z̈ + 2ζω ż + ω² z = ω² U",
            source="Preumont, Vibration Control of Active Structures, 4th ed. (2018), ch. 2",
            parameters=(
                FREQUENCY,
                DAMPING,
                EffectParameter(
                    "share", "r, share of the static motion along this path", "", -2.0, 2.0, 0.05
                ),
            ),
            acts=AddedStates(part=_make_parallel_path),
            traits=_LINEAR_TRAITS,
        ),
        Formulation(
            name="appendage",
            equation="ξ̈ = ω² (q − ξ) + 2ζω (q̇ − ξ̇), force on the axis −μ M ξ̈",
            source="Den Hartog, Mechanical Vibrations, 4th ed. (1956), ch. 3",
            parameters=(
                FREQUENCY,
                DAMPING,
                EffectParameter(
                    "mass_ratio", "μ, ratio of its mass to the axis' mass", "", 0.0, 2.0, 0.05
                ),
            ),
            acts=AddedStates(part=_make_appendage),
            traits=_LINEAR_TRAITS,
        ),
        Formulation(
            name="series",
            equation="y = (1 − r) q + r z, z̈ + 2ζω ż + ω² z = ω² q",
            source="Preumont, Vibration Control of Active Structures, 4th ed. (2018), ch. 2",
            parameters=(
                FREQUENCY,
                DAMPING,
                EffectParameter(
                    "share", "r, share of the motion seen through the link", "", -2.0, 2.0, 0.3
                ),
            ),
            acts=AddedStates(part=_make_series_link),
            traits=_LINEAR_TRAITS,
        ),
        Formulation(
            name="modes",
            equation="y = q + Σ (aₖ zₖ + bₖ żₖ/ωₖ), z̈ₖ + 2ζₖωₖ żₖ + ωₖ² zₖ = ωₖ² U",
            source="Gustavsen and Semlyen, IEEE Trans. Power Delivery 14 (1999) 1052-1061",
            parameters=make_modal_parameters(""),
            acts=AddedStates(part=make_modal_part),
            traits=frozenset({EffectTrait.LINEAR, EffectTrait.MEMORYLESS}),
            kinds=frozenset({"piezo", "stepper"}),
            by_spectra=True,
        ),
    ),
)
