"""Transport delay: the signal arrives later, otherwise unchanged."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputDelay,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_delays

DELAY = Effect(
    id="delay",
    title="Delay",
    summary="The phase grows with frequency while the gain stays 1.",
    stage=EffectStage.ELECTRONICS,
    kinds=EVERY_KIND,
    identification=IdentificationHints(
        starts=start_from_delays("delay", (0.3, 1.0, 4.0, 15.0), lambda _: 1.0),
        lateness_s=lambda values: values["delay"],
    ),
    kinship=EffectRelations(family=EffectFamily.LATE),
    formulations=(
        Formulation(
            name="transport",
            equation="y(t) = x(t − T), of any length, not only whole samples",
            source="definition",
            parameters=(EffectParameter("delay", "T", "s", 0.0, 0.1, 1e-3),),
            acts=InputDelay(delay_s=lambda values: values["delay"]),
            traits=frozenset({EffectTrait.LINEAR, EffectTrait.TRANSIENT, EffectTrait.MEMORYLESS}),
        ),
    ),
)
