"""A flexure that stiffens as it bends: a bowed static curve whose resonance moves with position."""

from collections.abc import Iterator

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Effect,
    Force,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification, View
from rotemina.sim.effects.kinship import Family, Kinship

_INNER_SHARE = 1.0 / 30.0  # of the axis' period; the error goes with its square


def cubic(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``f = −K (x − x₀)³`` at mid-step, where ``a f/2`` has moved it: midpoint rule, by Newton.

    p: K, x₀.
    """
    bent = x - p[1]
    force = 0.0
    for _ in range(2):
        at = bent + 0.5 * a * force
        force -= (force + p[0] * at**3) / (1.0 + 1.5 * a * p[0] * at**2)
    return force


def cubic_quintic(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``f = −(K₃ d³ + K₅ d⁵)``, ``d = x − x₀``, in the same way. p: K₃, x₀, K₅."""
    bent = x - p[1]
    force = 0.0
    for _ in range(3):
        at = bent + 0.5 * a * force
        square = at * at
        gap = force + (p[0] + p[2] * square) * square * at
        slope = 1.0 + 0.5 * a * (3.0 * p[0] + 5.0 * p[2] * square) * square
        force -= gap / slope
    return force


def _numbers(values: Values, facts: Facts) -> tuple[float, ...]:
    """Make ``hardening`` the force at half the range from x₀, over that of the linear stiffness.

    A little less than none is allowed, so that a fit may pass; with more, a step over the whole
    range could throw the axis out of its well.
    """
    reach = 0.5 * facts.span
    middle = 0.5 * (facts.low + facts.high)
    return (values["hardening"] * facts.stiffness / reach**2, middle + values["centre"])


def _two_numbers(values: Values, facts: Facts) -> tuple[float, ...]:
    reach = 0.5 * facts.span
    return (*_numbers(values, facts), values["quintic"] * facts.stiffness / reach**4)


def _inner_step(_values: Values, facts: Facts) -> float:
    return _INNER_SHARE / facts.frequency_hz


_HARDENING = Parameter(
    "hardening", "ε, share of added force at distance L from q₀", "", -0.01, 1.0, 0.05, linear=True
)
_CENTRE = Parameter(
    "centre", "position of the straight part, from mid-range", "q", -0.5, 0.5, 0.0, per="span"
)
_TRAITS = frozenset({Trait.MEMORYLESS, Trait.RATE_INDEPENDENT, Trait.DISSIPATIVE})

_CENTRES = (-0.45, -0.2, 0.0, 0.2, 0.45)  # of the range, from mid-range
_HARDER = (1.0, 4.0)  # presets


def _centres(view: View) -> Iterator[Values]:
    if view.given:  # a simpler form was fitted there
        yield {}
        return
    for share in _CENTRES:
        for times in _HARDER:
            yield {
                "centre": share * view.facts.span,
                "hardening": times * view.values["hardening"],
            }


STIFFNESS_NONLINEARITY = Effect(
    id="stiffness_nonlinearity",
    title="Stiffness nonlinearity",
    summary="A curved static characteristic, and a resonance that shifts with position.",
    stage=Stage.MECHANICS,
    kinds=frozenset({"piezo"}),
    identification=Identification(starts=_centres, from_other=dict),
    kinship=Kinship(brings_along={Family.GAIN: 1.0}),
    formulations=(
        Formulation(
            name="cubic",
            equation="f = −ε k (q − q₀)³ / L², L half the range, k the linear stiffness",
            source="Kovacic and Brennan, The Duffing Equation (2011), ch. 2",
            parameters=(_HARDENING, _CENTRE),
            acts=Force(step=cubic),
            prepare=_numbers,
            inner_step_s=_inner_step,
            traits=_TRAITS,
        ),
        Formulation(
            name="cubic_quintic",
            equation="f = −k (ε (q − q₀)³ / L² + μ (q − q₀)⁵ / L⁴), L half the range",
            source="Kovacic and Brennan, The Duffing Equation (2011), ch. 2",
            parameters=(
                _HARDENING,
                _CENTRE,
                Parameter("quintic", "μ, the same for the fifth power", "", 0.0, 1.0, 0.02),
            ),
            acts=Force(step=cubic_quintic),
            prepare=_two_numbers,
            inner_step_s=_inner_step,
            traits=_TRAITS,
        ),
    ),
)
