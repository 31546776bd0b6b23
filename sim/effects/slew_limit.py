"""Slew rate: the amplifier's current limit into the capacitance of a piezo, i = C dU/dt."""

import numpy as np

from rotemina.sim.effects.amplifier_lag import compute_inner_step
from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
    Values,
)
from rotemina.sim.effects.identification import IdentificationHints, Interval, RecordCoverage
from rotemina.sim.effects.starts import start_from_sizes

# From this v on, sinh v equals eᵛ/2 to within rounding.
_MIN_EXPONENTIAL_ARGUMENT = 20.0
# Ends of the panels over which v is integrated numerically.
_PANEL_ENDS = (0.0, 1.0, 3.0, 8.0, _MIN_EXPONENTIAL_ARGUMENT)
_PANEL_COUNT = len(_PANEL_ENDS) - 1
# Node of Gauss' rule with three nodes on [−1, 1].
_GAUSS_NODE = np.sqrt(0.6)


def limit_rate(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``ẏ = ±r`` until y reaches x, and return the mean of y over the step.

    p: r; s: y.
    """
    if h == 0.0:
        return s[0]
    distance, max_move = x - s[0], p[0] * h
    if abs(distance) <= max_move:
        s[0] = x
        return x - 0.5 * distance * abs(distance) / max_move
    move = max_move if distance > 0.0 else -max_move
    s[0] += move
    return s[0] - 0.5 * move


def limit_rate_softly(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``ẏ = r tanh((x − y)/(r τ))``: a lag that cannot be faster than r.

    With ``v = (x − y)/(rτ)``: ``sinh v₁ = sinh v exp(−h/τ)``, and the integral of ``x − y`` is
    ``rτ² ∫ v coth v dv`` from v₁ to v, where ``v coth v = v + 2v/(exp 2v − 1)``. The last term is
    integrated by Gauss' rule.

    p: r, τ; s: y.
    """
    if h == 0.0:
        return s[0]
    scale = p[0] * p[1]
    v = abs(x - s[0]) / scale
    if v > _MIN_EXPONENTIAL_ARGUMENT:
        linear_v = v - h / p[1]
        v_after = (
            linear_v if linear_v > _MIN_EXPONENTIAL_ARGUMENT else np.arcsinh(0.5 * np.exp(linear_v))
        )
    else:
        v_after = np.arcsinh(np.sinh(v) * np.exp(-h / p[1]))
    area = 0.5 * (v - v_after) * (v + v_after)
    for k in range(_PANEL_COUNT):
        low, high = max(v_after, _PANEL_ENDS[k]), min(v, _PANEL_ENDS[k + 1])
        if high > low:
            panel_middle, half_panel = 0.5 * (low + high), 0.5 * (high - low)
            u0, u2 = (
                panel_middle - _GAUSS_NODE * half_panel,
                panel_middle + _GAUSS_NODE * half_panel,
            )
            total = 5.0 * u0 / np.expm1(2.0 * u0) + 8.0 * panel_middle / np.expm1(
                2.0 * panel_middle
            )
            area += 2.0 / 9.0 * half_panel * (total + 5.0 * u2 / np.expm1(2.0 * u2))
    mean_distance, distance_after = scale * p[1] / h * area, scale * v_after
    forward = x > s[0]
    s[0] = x - distance_after if forward else x + distance_after
    return x - mean_distance if forward else x + mean_distance


RATE = EffectParameter(
    "rate",
    "r, maximum rate; current over capacitance",
    "u/s",
    0.1,
    1e6,
    100.0,
    per="input_span",
)
_TRAITS = frozenset({EffectTrait.TRANSIENT, EffectTrait.MEMORYLESS})

# Shortest time in which an axis may be commanded over its whole travel.
_FASTEST_TRAVEL_S = 5e-4


def _limit_rate_domain(
    _values: Values, facts: AxisProperties, bounds: Interval, extent: RecordCoverage
) -> Interval:
    """Return rates, in units of the input per second, up to one that hardly any motion requests.

    A higher rate never limits anything: a soft limit would only look like a lag.
    """
    low, high = bounds
    fastest_request = (extent.reach[1] - extent.reach[0]) / facts.gain / _FASTEST_TRAVEL_S
    return low, max(min(high, fastest_request), 2.0 * low)


SLEW_LIMIT = Effect(
    id="slew_limit",
    title="Slew limit",
    summary="Limits only large, fast motion, which becomes a triangle.",
    stage=EffectStage.ELECTRONICS,
    kinds=frozenset({"piezo"}),
    identification=IdentificationHints(
        starts=start_from_sizes(rate=(10.0, 3.0, 1.0, 0.3, 0.1, 0.03)),
        domain={"rate": _limit_rate_domain},
    ),
    formulations=(
        Formulation(
            name="hard",
            equation="ẏ = r sign(x − y) until y = x",
            source="Fleming and Leang, Design, Modeling and Control of Nanopositioning Systems "
            "(2014), ch. 14",
            parameters=(RATE,),
            acts=InputFunction(step=limit_rate, states=1, timed=True),
            inner_step_s=compute_inner_step,
            traits=_TRAITS,
        ),
        Formulation(
            name="soft",
            equation="ẏ = r tanh((x − y)/(r τ))",
            source="Gray, Hurst, Lewis, Meyer, Analysis and Design of Analog Integrated Circuits, "
            "5th ed. (2009), ch. 9.6: an emitter-coupled pair charges a capacitor",
            parameters=(
                RATE,
                EffectParameter("time_constant", "τ, for small changes", "s", 1e-9, 0.1, 3e-4),
            ),
            acts=InputFunction(step=limit_rate_softly, states=1, timed=True),
            inner_step_s=compute_inner_step,
            traits=_TRAITS,
        ),
    ),
)
