"""Error of the lead screw: the table runs ahead and lags behind once per turn."""

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    PositionFunction,
)
from rotemina.sim.effects.harmonics import add_two_harmonics, compute_numbers, make_amplitude_shift
from rotemina.sim.effects.identification import (
    IdentificationHints,
    Interval,
    RecordCoverage,
    Values,
)
from rotemina.sim.effects.kinship import EffectFamily, EffectRelations
from rotemina.sim.effects.starts import start_from_periods

# Relative tolerance of a period of one turn or half a turn.
_PERIOD_TOLERANCE_RATIO = 0.02
# A longer period, in turns, is that of a whole turn; a shorter one is at most half a turn.
_MIN_WHOLE_TURN_RATIO = 0.75


def _make_amplitude(name: str, meaning: str, typical: float) -> EffectParameter:
    return EffectParameter(name, meaning, "q", -0.02, 0.02, typical, per="pitch", linear=True)


def _limit_period(
    values: Values, facts: AxisProperties, bounds: Interval, extent: RecordCoverage
) -> Interval:
    """Return periods near a turn, or up to half a turn, if a robot file declares the pitch.

    Any other error that is periodic in position does not come from the screw.
    """
    if not facts.has_pitch:
        return bounds
    low_ratio, high_ratio = 1.0 - _PERIOD_TOLERANCE_RATIO, 1.0 + _PERIOD_TOLERANCE_RATIO
    if values["period"] > _MIN_WHOLE_TURN_RATIO * facts.pitch:
        return facts.pitch * low_ratio, facts.pitch * high_ratio
    return bounds[0], 0.5 * facts.pitch * high_ratio


LEADSCREW_ERROR = Effect(
    id="leadscrew_error",
    title="Lead screw error",
    summary="Periodic in position, once per turn: its frequency grows with speed.",
    stage=EffectStage.MECHANICS,
    kinds=frozenset({"stepper", "force"}),
    identification=IdentificationHints(
        starts=start_from_periods(1.0),
        domain={"period": _limit_period},
        moved=make_amplitude_shift(("sine", "cosine"), ("sine_2", "cosine_2")),
    ),
    kinship=EffectRelations(family=EffectFamily.PERIOD),
    formulations=(
        Formulation(
            name="harmonics",
            equation="y = x + s₁ sin α + c₁ cos α + s₂ sin 2α + c₂ cos 2α, α = 2π (x − xₘ)/P",
            source="ISO 3408-3 (2006): travel deviation within 2π rad",
            parameters=(
                EffectParameter(
                    "period", "P, one turn or a fraction of it", "q", 0.05, 1.2, 1.0, per="pitch"
                ),
                _make_amplitude("sine", "s₁, counted from mid-range xₘ", 0.002),
                _make_amplitude("cosine", "c₁", 0.0),
                _make_amplitude("sine_2", "s₂, twice a period", 0.0),
                _make_amplitude("cosine_2", "c₂, twice a period", 0.0),
            ),
            acts=PositionFunction(step=add_two_harmonics),
            prepare=compute_numbers,
            traits=frozenset({EffectTrait.MEMORYLESS, EffectTrait.RATE_INDEPENDENT}),
        ),
    ),
)
