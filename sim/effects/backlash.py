"""Backlash: after a reversal the table stays in place until the play is taken up.

The play may lie behind the springs of the axis (``rigid``, ``compliant``), or before them, in the
screw (``screw``, ``compliant_screw``). In the latter case, the table rings as after any step
command once the screw moves it again.
"""

from math import inf

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
    PositionFunction,
    Values,
)
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_sizes

PLAY_COUNT = 8
# Inner step in periods of the axis, fine enough to resolve its turning points.
_INNER_STEP_PERIODS = 1.0 / 20.0
# Inner step of an axis without stiffness, which has no period.
_FREE_AXIS_STEP_S = 1e-3


def apply_play(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = max(x − w/2, min(x + w/2, y))``.

    p: w/2, low end of the range; s: y counted from there.
    """
    offset = x - p[1]
    s[0] = max(offset - p[0], min(offset + p[0], s[0]))
    return x + (s[0] - offset)


def apply_plays(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply the mean of several plays of different widths.

    p: low end of the range, then half of each width; s: y of each play.
    """
    offset = x - p[0]
    lag = 0.0
    for i in range(PLAY_COUNT):
        s[i] = max(offset - p[1 + i], min(offset + p[1 + i], s[i]))
        lag += s[i] - offset
    return x + lag / PLAY_COUNT


def _spread_plays(values: Values, facts: AxisProperties) -> tuple[float, ...]:
    """Return p; the widths are evenly spaced from ``w (1 − softness)`` to ``w (1 + softness)``."""
    relative_offsets = [(2.0 * i + 1.0) / PLAY_COUNT - 1.0 for i in range(PLAY_COUNT)]
    half_width = 0.5 * values["width"]
    return (
        facts.low,
        *(
            half_width * (1.0 + values["softness"] * relative_offset)
            for relative_offset in relative_offsets
        ),
    )


def compute_inner_step(_values: Values, facts: AxisProperties) -> float:
    """Return an inner step, s, that resolves the turning points of the axis.

    A static axis turns only at samples.
    """
    if facts.is_static:
        return inf
    return (
        _INNER_STEP_PERIODS / facts.frequency_hz if facts.frequency_hz > 0.0 else _FREE_AXIS_STEP_S
    )


SOFTNESS = EffectParameter("softness", "0: rigid; 1: absorbed from the start", "", 0.0, 1.0, 0.5)
WIDTH = EffectParameter("width", "of the play", "q", 0.0, 0.2, 1e-4, per="span")

BACKLASH = Effect(
    id="backlash",
    title="Backlash",
    summary="A dead band at each reversal, equally wide at any amplitude and speed.",
    stage=EffectStage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    identification=IdentificationHints(starts=start_from_sizes(width=(0.1, 0.5, 2.0))),
    kinship=EffectRelations(
        family=EffectFamily.LOST_MOTION, brings_along={EffectFamily.RESONANCE: 0.25}
    ),
    formulations=(
        Formulation(
            name="rigid",
            equation="y = max(x − w/2, min(x + w/2, y))",
            source="Nordin and Gutman, Automatica 38 (2002) 1633–1649",
            parameters=(WIDTH,),
            acts=PositionFunction(step=apply_play, states=1),
            prepare=lambda values, facts: (0.5 * values["width"], facts.low),
            inner_step_s=compute_inner_step,
            traits=frozenset({EffectTrait.RATE_INDEPENDENT}),
        ),
        Formulation(
            name="compliant",
            equation="y = Σ yᵢ / n, yᵢ = max(x − wᵢ/2, min(x + wᵢ/2, yᵢ)), wᵢ = w (1 ± softness)",
            source="Brokate and Sprekels, Hysteresis and Phase Transitions (1996), ch. 2",
            parameters=(WIDTH, SOFTNESS),
            acts=PositionFunction(step=apply_plays, states=PLAY_COUNT),
            prepare=_spread_plays,
            inner_step_s=compute_inner_step,
            traits=frozenset({EffectTrait.RATE_INDEPENDENT}),
        ),
        Formulation(
            name="screw",
            equation="U' = max(U − w/2, min(U + w/2, U')) drives the mass and its spring",
            source="Nordin and Gutman, Automatica 38 (2002) 1633–1649",
            parameters=(WIDTH,),
            acts=InputFunction(step=apply_play, states=1),
            prepare=lambda values, facts: (0.5 * values["width"], facts.low),
            kinds=frozenset({"stepper"}),
            traits=frozenset({EffectTrait.RATE_INDEPENDENT}),
        ),
        Formulation(
            name="compliant_screw",
            equation="U' = Σ Uᵢ' / n, the plays of widths w (1 ± softness), drives mass and spring",
            source="Brokate and Sprekels, Hysteresis and Phase Transitions (1996), ch. 2",
            parameters=(WIDTH, SOFTNESS),
            acts=InputFunction(step=apply_plays, states=PLAY_COUNT),
            prepare=_spread_plays,
            kinds=frozenset({"stepper"}),
            traits=frozenset({EffectTrait.RATE_INDEPENDENT}),
        ),
    ),
)
