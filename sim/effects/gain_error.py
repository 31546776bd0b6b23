"""A sensitivity that is off by a few per cent."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
)
from rotemina.sim.effects.identification import Identification, Retuning
from rotemina.sim.effects.kinship import Family, Kinship


def scaled(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = (1 + e) x``. p: e."""
    return x + p[0] * x


GAIN_ERROR = Effect(
    id="gain_error",
    title="Gain error",
    summary="Proportional to the command, without memory.",
    stage=Stage.ACTUATOR,
    kinds=EVERY_KIND,
    identification=Identification(retunes=lambda _: Retuning(None, {"error": 0.0})),
    kinship=Kinship(family=Family.GAIN),
    formulations=(
        Formulation(
            name="relative",
            equation="y = (1 + e) x, counted from where the command is zero",
            source="ISO/IEC Guide 99 (VIM, 2007), 4.12: sensitivity",
            parameters=(Parameter("error", "e, error of the sensitivity", "", -0.5, 0.5, 0.03),),
            acts=Drive(step=scaled),
            traits=frozenset({Trait.LINEAR, Trait.MEMORYLESS, Trait.RATE_INDEPENDENT}),
        ),
    ),
)
