"""A sensor that keeps a time of its own, faster or slower than the controller's."""

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Parameter,
    Skew,
    Stage,
    Trait,
)

CLOCK_SKEW = Effect(
    id="clock_skew",
    title="Clock skew",
    summary="A lag of the reading that grows along the record.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    formulations=(
        Formulation(
            name="constant_rate",
            equation="y(t) = q(t − 10⁻⁶ r t), t from the start of the run",
            source="Allan, IEEE Trans. UFFC 34 (1987) 647–654",
            parameters=(
                Parameter("skew", "r; more than 0: readings come later", "ppm", -1e4, 1e4, 100.0),
            ),
            acts=Skew(rate=lambda values: 1e-6 * values["skew"]),
            traits=frozenset({Trait.LINEAR, Trait.MEMORYLESS, Trait.TRANSIENT, Trait.READING_ONLY}),
        ),
    ),
)
