"""Backlash: at a reversal the table stays behind until the play is used up."""

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Effect,
    Formulation,
    Motion,
    Parameter,
    Stage,
    Trait,
    Values,
)

_INNER_SHARE = 1.0 / 20.0  # of the axis' period: how finely its turning points are seen
_FREE_STEP_S = 1e-3


def play(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = max(x − w/2, min(x + w/2, y))``. p: w/2, low end of the range; s: y from there."""
    x -= p[1]
    s[0] = max(x - p[0], min(x + p[0], s[0]))
    return s[0] + p[1]


def fine_enough(_values: Values, facts: Facts) -> float:
    """Return a step with which turning points are seen."""
    return _INNER_SHARE / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_STEP_S


WIDTH = Parameter("width", "of the play", "q", 0.0, 0.2, 1e-4, per="span")

BACKLASH = Effect(
    id="backlash",
    title="Backlash",
    summary="A dead band at each reversal, as wide at any amplitude and speed.",
    stage=Stage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    formulations=(
        Formulation(
            name="rigid",
            equation="y = max(x − w/2, min(x + w/2, y))",
            source="Nordin and Gutman, Automatica 38 (2002) 1633–1649",
            parameters=(WIDTH,),
            acts=Motion(step=play, states=1),
            prepare=lambda values, facts: (0.5 * values["width"], facts.low),
            inner_step_s=fine_enough,
            traits=frozenset({Trait.RATE_INDEPENDENT}),
        ),
    ),
)
