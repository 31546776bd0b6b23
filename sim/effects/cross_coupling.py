"""Cross coupling: the motion of another axis adds to the motion of this one.

``q_j`` is the absolute position of ``from_axis`` before any effect on it. A static coupling
therefore also shifts the axis in proportion to the other one's rest position. The unit of k is
the unit of this axis divided by that of ``from_axis``.
"""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.arrays import FloatArray
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
    PositionFunction,
    Values,
)
from rotemina.sim.effects.identification import FitView, IdentificationHints
from rotemina.sim.effects.kinship import EffectRelations
from rotemina.sim.effects.modes import make_modal_parameters, make_modal_part
from rotemina.sim.effects.starts import regress_other_command, start_from_modes


def add_other_position(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Add the position of the other axis, ``y = x + k q_j``. p: k."""
    return x + p[0] * other


def _make_mode_matrices(values: Values) -> tuple[FloatArray, FloatArray]:
    """Return A and B of ``z̈ + 2ζω ż + ω² z = ω² q_j``."""
    rate = 2.0 * np.pi * values["frequency"]
    a = np.array([[0.0, 1.0], [-(rate**2), -2.0 * values["damping_ratio"] * rate]])
    return a, np.array([[0.0, 0.0, 0.0], [rate**2, 0.0, 0.0]])


def _make_mode(values: Values, _facts: AxisProperties) -> LinearPart:
    a, b = _make_mode_matrices(values)
    return LinearPart(a=a, b=b, output=np.array([values["k"], 0.0]))


def _make_transient_mode(values: Values, _facts: AxisProperties) -> LinearPart:
    a, b = _make_mode_matrices(values)
    return LinearPart(a=a, b=b, output=np.array([-values["k"], 0.0]), share=values["k"])


_K = EffectParameter(
    "k", "ratio of the motion here to the motion there", "q/…", -100.0, 100.0, 0.02
)
_FREQUENCY = EffectParameter("frequency", "of the mode", "Hz", 0.02, 50.0, 0.5, per="pace_hz")
_DAMPING = EffectParameter("damping_ratio", "of the mode", "", 1e-4, 2.0, 0.05)
_SOURCE = "Skogestad and Postlethwaite, Multivariable Feedback Control, 2nd ed. (2005), ch. 3"
_LINEAR_TRAITS = frozenset({EffectTrait.LINEAR, EffectTrait.MEMORYLESS})


def _start_from_regression(view: FitView) -> Iterator[Values]:
    k = regress_other_command(view, "k")
    if "frequency" not in view.values:
        yield {"k": k}
        return
    for start in start_from_modes(view):
        yield {"k": k or view.values["k"], **start}


CROSS_COUPLING = Effect(
    id="cross_coupling",
    title="Cross coupling",
    summary="Follows the motion of another axis.",
    stage=EffectStage.MECHANICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(starts=_start_from_regression),
    kinship=EffectRelations(prior=0.7),
    coupled=True,
    formulations=(
        Formulation(
            name="static",
            equation="y = x + k q_j",
            source=_SOURCE,
            parameters=(_K,),
            acts=PositionFunction(step=add_other_position),
            traits=_LINEAR_TRAITS | {EffectTrait.RATE_INDEPENDENT},
        ),
        Formulation(
            name="mode",
            equation="y = x + k z, z̈ + 2ζω ż + ω² z = ω² q_j",
            source=_SOURCE,
            parameters=(_K, _FREQUENCY, _DAMPING),
            acts=AddedStates(part=_make_mode),
            traits=_LINEAR_TRAITS,
        ),
        Formulation(
            name="moving",
            equation="y = x + k (q_j − z), z̈ + 2ζω ż + ω² z = ω² q_j: nothing at rest",
            source=_SOURCE,
            parameters=(_K, _FREQUENCY, _DAMPING),
            acts=AddedStates(part=_make_transient_mode),
            traits=_LINEAR_TRAITS | {EffectTrait.TRANSIENT},
        ),
        Formulation(
            name="modes",
            equation="y = x + Σ (aₖ zₖ + bₖ żₖ/ωₖ), z̈ₖ + 2ζₖωₖ żₖ + ωₖ² zₖ = ωₖ² U_j",
            source="Gustavsen and Semlyen, IEEE Trans. Power Delivery 14 (1999) 1052-1061",
            parameters=make_modal_parameters("q/…"),
            acts=AddedStates(part=make_modal_part),
            traits=_LINEAR_TRAITS,
            by_spectra=True,
        ),
    ),
)
