"""Sensitivity that is off by a few per cent."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
)
from rotemina.sim.effects.identification import IdentificationHints, RetunedParameters
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations


def scale_input(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = (1 + e) x``. p: e."""
    return x + p[0] * x


GAIN_ERROR = Effect(
    id="gain_error",
    title="Gain error",
    summary="Proportional to the command, without memory.",
    stage=EffectStage.ACTUATOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(retunes=lambda _: RetunedParameters(None, {"error": 0.0})),
    kinship=EffectRelations(family=EffectFamily.GAIN),
    formulations=(
        Formulation(
            name="relative",
            equation="y = (1 + e) x, counted from where the command is zero",
            source="ISO/IEC Guide 99 (VIM, 2007), 4.12: sensitivity",
            parameters=(
                EffectParameter("error", "e, error of the sensitivity", "", -0.5, 0.5, 0.03),
            ),
            acts=InputFunction(step=scale_input),
            traits=frozenset(
                {EffectTrait.LINEAR, EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT}
            ),
        ),
    ),
)
