"""Backlash: at a reversal the table stays in place until the play is taken up.

The play may lie behind the springs of the axis (``rigid``, ``compliant``), or in the screw before
them (``screw``): then the table, once it is taken along, rings as after any step.
"""

from math import inf

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Drive,
    Effect,
    Formulation,
    Motion,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Family, Kinship
from rotemina.sim.effects.starts import sizes

FLANKS = 8
_INNER_SHARE = 1.0 / 20.0  # of the axis' period: how finely its turning points are seen
_FREE_STEP_S = 1e-3


def play(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = max(x − w/2, min(x + w/2, y))``. p: w/2, low end of the range; s: y from there."""
    risen = x - p[1]
    s[0] = max(risen - p[0], min(risen + p[0], s[0]))
    return x + (s[0] - risen)


def flanks(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Return the mean of plays of different widths. p: low end, half of each width; s: each y."""
    risen = x - p[0]
    behind = 0.0
    for i in range(FLANKS):
        s[i] = max(risen - p[1 + i], min(risen + p[1 + i], s[i]))
        behind += s[i] - risen
    return x + behind / FLANKS


def _spread(values: Values, facts: Facts) -> tuple[float, ...]:
    """Spread the plays evenly between ``w (1 − softness)`` and ``w (1 + softness)``."""
    places = [(2.0 * i + 1.0) / FLANKS - 1.0 for i in range(FLANKS)]
    half = 0.5 * values["width"]
    return (facts.low, *(half * (1.0 + values["softness"] * place) for place in places))


def fine_enough(_values: Values, facts: Facts) -> float:
    """Return a step that resolves turning points; a static axis turns only at samples."""
    if facts.is_static:
        return inf
    return _INNER_SHARE / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_STEP_S


SOFTNESS = Parameter("softness", "0: rigid; 1: absorbed from the start", "", 0.0, 1.0, 0.5)
WIDTH = Parameter("width", "of the play", "q", 0.0, 0.2, 1e-4, per="span")

BACKLASH = Effect(
    id="backlash",
    title="Backlash",
    summary="A dead band at each reversal, equally wide at any amplitude and speed.",
    stage=Stage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    identification=Identification(starts=sizes(width=(0.1, 0.5, 2.0))),
    kinship=Kinship(family=Family.LOST_MOTION, brings_along={Family.RESONANCE: 0.25}),
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
        Formulation(
            name="compliant",
            equation="y = Σ yᵢ / n, yᵢ = max(x − wᵢ/2, min(x + wᵢ/2, yᵢ)), wᵢ = w (1 ± softness)",
            source="Brokate and Sprekels, Hysteresis and Phase Transitions (1996), ch. 2",
            parameters=(WIDTH, SOFTNESS),
            acts=Motion(step=flanks, states=FLANKS),
            prepare=_spread,
            inner_step_s=fine_enough,
            traits=frozenset({Trait.RATE_INDEPENDENT}),
        ),
        Formulation(
            name="screw",
            equation="U' = max(U − w/2, min(U + w/2, U')) drives the mass and its spring",
            source="Nordin and Gutman, Automatica 38 (2002) 1633–1649",
            parameters=(WIDTH,),
            acts=Drive(step=play, states=1),
            prepare=lambda values, facts: (0.5 * values["width"], facts.low),
            kinds=frozenset({"stepper"}),
            traits=frozenset({Trait.RATE_INDEPENDENT}),
        ),
        Formulation(
            name="compliant_screw",
            equation="U' = Σ Uᵢ' / n, the plays of widths w (1 ± softness), drives mass and spring",
            source="Brokate and Sprekels, Hysteresis and Phase Transitions (1996), ch. 2",
            parameters=(WIDTH, SOFTNESS),
            acts=Drive(step=flanks, states=FLANKS),
            prepare=_spread,
            kinds=frozenset({"stepper"}),
            traits=frozenset({Trait.RATE_INDEPENDENT}),
        ),
    ),
)
