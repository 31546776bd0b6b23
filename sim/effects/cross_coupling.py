"""Cross coupling: the motion of another axis leaks into this one.

``q_j`` is the absolute position of ``from_axis`` before any effect on it, so a static coupling also
shifts the axis by the other one's position of rest. The unit of k is this axis' unit over that of
``from_axis``.
"""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    LinearPart,
    Motion,
    Parameter,
    Part,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification, View
from rotemina.sim.effects.kinship import Kinship
from rotemina.sim.effects.modes import modal_parameters, modal_part
from rotemina.sim.effects.starts import modes, regressed


def leak(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + k q_j``. p: k."""
    return x + p[0] * other


def _states(values: Values) -> tuple[FloatArray, FloatArray]:
    """Return A and B of ``z̈ + 2ζω ż + ω² z = ω² q_j``."""
    rate = 2.0 * np.pi * values["frequency"]
    a = np.array([[0.0, 1.0], [-(rate**2), -2.0 * values["damping_ratio"] * rate]])
    return a, np.array([[0.0, 0.0, 0.0], [rate**2, 0.0, 0.0]])


def _through_mode(values: Values, _facts: Facts) -> LinearPart:
    a, b = _states(values)
    return LinearPart(a=a, b=b, output=np.array([values["k"], 0.0]))


def _while_moving(values: Values, _facts: Facts) -> LinearPart:
    a, b = _states(values)
    return LinearPart(a=a, b=b, output=np.array([-values["k"], 0.0]), share=values["k"])


_K = Parameter("k", "ratio of the motion here to the motion there", "q/…", -100.0, 100.0, 0.02)
_FREQUENCY = Parameter("frequency", "of the mode", "Hz", 0.02, 50.0, 0.5, per="pace_hz")
_DAMPING = Parameter("damping_ratio", "of the mode", "", 1e-4, 2.0, 0.05)
_SOURCE = "Skogestad and Postlethwaite, Multivariable Feedback Control, 2nd ed. (2005), ch. 3"
_LINEAR = frozenset({Trait.LINEAR, Trait.MEMORYLESS})


def _couplings(view: View) -> Iterator[Values]:
    k = regressed(view, "k")
    if "frequency" not in view.values:
        yield {"k": k}
        return
    for start in modes(view):
        yield {"k": k or view.values["k"], **start}


CROSS_COUPLING = Effect(
    id="cross_coupling",
    title="Cross coupling",
    summary="Follows the motion of another axis.",
    stage=Stage.MECHANICS,
    kinds=EVERY_KIND,
    identification=Identification(starts=_couplings),
    kinship=Kinship(prior=0.7),
    coupled=True,
    formulations=(
        Formulation(
            name="static",
            equation="y = x + k q_j",
            source=_SOURCE,
            parameters=(_K,),
            acts=Motion(step=leak),
            traits=_LINEAR | {Trait.RATE_INDEPENDENT},
        ),
        Formulation(
            name="mode",
            equation="y = x + k z, z̈ + 2ζω ż + ω² z = ω² q_j",
            source=_SOURCE,
            parameters=(_K, _FREQUENCY, _DAMPING),
            acts=Part(part=_through_mode),
            traits=_LINEAR,
        ),
        Formulation(
            name="moving",
            equation="y = x + k (q_j − z), z̈ + 2ζω ż + ω² z = ω² q_j: nothing at rest",
            source=_SOURCE,
            parameters=(_K, _FREQUENCY, _DAMPING),
            acts=Part(part=_while_moving),
            traits=_LINEAR | {Trait.TRANSIENT},
        ),
        Formulation(
            name="modes",
            equation="y = x + Σ (aₖ zₖ + bₖ żₖ/ωₖ), z̈ₖ + 2ζₖωₖ żₖ + ωₖ² zₖ = ωₖ² U_j",
            source="Gustavsen and Semlyen, IEEE Trans. Power Delivery 14 (1999) 1052-1061",
            parameters=modal_parameters("q/…"),
            acts=Part(part=modal_part),
            traits=_LINEAR,
            by_spectra=True,
        ),
    ),
)
