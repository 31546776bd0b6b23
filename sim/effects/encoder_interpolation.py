"""An encoder that divides the period of its grating unevenly."""

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Effect,
    Formulation,
    Parameter,
    Reading,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.harmonics import moved
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import periods


def subdivided(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + S₁ sin φ + C₁ cos φ + S₂ sin 2φ + C₂ cos 2φ``. p: dφ/dq, S₁, C₁, S₂, C₂."""
    phase = p[0] * other
    sine, cosine = np.sin(phase), np.cos(phase)
    twice_sine, twice_cosine = 2.0 * sine * cosine, 1.0 - 2.0 * sine * sine
    return x + p[1] * sine + p[2] * cosine + p[3] * twice_sine + p[4] * twice_cosine


def _by_phase(values: Values, _facts: Facts) -> tuple[float, ...]:
    harmonics = (values[name] for name in ("sine", "cosine", "second_sine", "second_cosine"))
    return 2.0 * np.pi / values["period"], *harmonics


def _amplitude(name: str, meaning: str, typical: float) -> Parameter:
    return Parameter(name, meaning, "q", -1e-5, 1e-5, typical, linear=True)


# Gratings are ruled at 20 μm as a rule, else at 4, 8, 10 or 40 μm. Over records far apart, a period
# that is but nearly right is in phase with none.
_GRATINGS = (1.0, 0.2, 0.4, 0.5, 2.0)


ENCODER_INTERPOLATION = Effect(
    id="encoder_interpolation",
    title="Encoder interpolation error",
    summary="Periodic in position with the period of the grating, only in the reading.",
    stage=Stage.SENSOR,
    kinds=frozenset({"stepper", "force"}),
    identification=Identification(
        starts=periods(*_GRATINGS),
        domain={"period": (1e-7, 2e-4)},  # a screw's, beyond
        moved=moved(("sine", "cosine"), ("second_sine", "second_cosine")),
    ),
    kinship=Kinship(family=Family.PERIOD),
    formulations=(
        Formulation(
            name="two_harmonics",
            equation="y = q + S₁ sin φ + C₁ cos φ + S₂ sin 2φ + C₂ cos 2φ, φ = 2π q/p",
            source="Heydemann, Applied Optics 20 (1981) 3382–3384",
            parameters=(
                Parameter("period", "p, period of the grating", "q", 1e-7, 1e-2, 20e-6),
                _amplitude("sine", "S₁, with cosine: offsets of the two signals", 1e-7),
                _amplitude("cosine", "C₁", 0.0),
                _amplitude("second_sine", "S₂, with its cosine: unlike gains, phase off 90°", 5e-8),
                _amplitude("second_cosine", "C₂", 0.0),
            ),
            acts=Reading(step=subdivided),
            prepare=_by_phase,
            traits=frozenset(
                {Trait.LOCKED_TO_POSITION, Trait.RATE_INDEPENDENT, Trait.READING_ONLY}
            ),
        ),
    ),
)
