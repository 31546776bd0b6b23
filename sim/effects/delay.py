"""Transport delay: everything happens later, otherwise unchanged."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Late,
    Parameter,
    Stage,
    Trait,
)
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import late

DELAY = Effect(
    id="delay",
    title="Delay",
    summary="The phase grows with frequency while the gain stays 1.",
    stage=Stage.ELECTRONICS,
    kinds=EVERY_KIND,
    identification=Identification(
        starts=late("delay", (0.3, 1.0, 4.0, 15.0), lambda _: 1.0),
        lateness_s=lambda values: values["delay"],
    ),
    kinship=Kinship(family=Family.LATE),
    formulations=(
        Formulation(
            name="transport",
            equation="y(t) = x(t − T), of any length, not only whole samples",
            source="definition",
            parameters=(Parameter("delay", "T", "s", 0.0, 0.1, 1e-3),),
            acts=Late(delay_s=lambda values: values["delay"]),
            traits=frozenset({Trait.LINEAR, Trait.TRANSIENT, Trait.MEMORYLESS}),
        ),
    ),
)
