"""Error of the lead screw: the table runs ahead and behind once a turn."""

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Effect,
    Formulation,
    Motion,
    Parameter,
    Stage,
    Trait,
)
from rotemina.sim.effects.harmonics import from_mid_range, moved, two_harmonics
from rotemina.sim.effects.identification import Extent, Identification, Interval, Values
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import periods

_SLACK = 0.02  # of a period, by which it may differ from a turn or half of one
_BETWEEN = 0.75  # of a turn, from which a period is a whole one's


def _amplitude(name: str, meaning: str, typical: float) -> Parameter:
    return Parameter(name, meaning, "q", -0.02, 0.02, typical, per="pitch", linear=True)


def _of_a_turn(values: Values, facts: Facts, bounds: Interval, extent: Extent) -> Interval:
    """Return periods near a turn, or of half of one at most, where a robot file names the pitch.

    What repeats otherwise along the way is not the screw's.
    """
    if not facts.has_pitch:
        return bounds
    if values["period"] > _BETWEEN * facts.pitch:
        return facts.pitch * (1.0 - _SLACK), facts.pitch * (1.0 + _SLACK)
    return bounds[0], 0.5 * facts.pitch * (1.0 + _SLACK)


LEADSCREW_ERROR = Effect(
    id="leadscrew_error",
    title="Lead screw error",
    summary="Periodic in position, once per turn: its frequency grows with speed.",
    stage=Stage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    identification=Identification(
        starts=periods(1.0),
        domain={"period": _of_a_turn},
        moved=moved(("sine", "cosine"), ("sine_2", "cosine_2")),
    ),
    kinship=Kinship(family=Family.PERIOD),
    formulations=(
        Formulation(
            name="harmonics",
            equation="y = x + s₁ sin α + c₁ cos α + s₂ sin 2α + c₂ cos 2α, α = 2π (x − xₘ)/P",
            source="ISO 3408-3 (2006): travel deviation within 2π rad",
            parameters=(
                Parameter(
                    "period", "P, one turn or a fraction of it", "q", 0.05, 1.2, 1.0, per="pitch"
                ),
                _amplitude("sine", "s₁, counted from mid-range xₘ", 0.002),
                _amplitude("cosine", "c₁", 0.0),
                _amplitude("sine_2", "s₂, twice a period", 0.0),
                _amplitude("cosine_2", "c₂, twice a period", 0.0),
            ),
            acts=Motion(step=two_harmonics),
            prepare=from_mid_range,
            traits=frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT}),
        ),
    ),
)
