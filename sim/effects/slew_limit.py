"""Slew rate: the amplifier's current limit into the capacitance of a piezo, i = C dU/dt."""

import numpy as np

from rotemina.sim.effects.amplifier_lag import inner_step
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Extent, Identification, Interval
from rotemina.sim.effects.starts import sizes

_STEEP = 20.0  # where sinh v is eᵛ/2 to rounding
_PANEL_ENDS = (0.0, 1.0, 3.0, 8.0, _STEEP)
_PANELS = len(_PANEL_ENDS) - 1
_NODE = np.sqrt(0.6)  # of Gauss' rule with three nodes on [−1, 1]


def hard(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``ẏ = ±r`` until y has come to x; the mean is that of the straight line. p: r; s: y."""
    if h == 0.0:
        return s[0]
    way, reach = x - s[0], p[0] * h
    if abs(way) <= reach:
        s[0] = x
        return x - 0.5 * way * abs(way) / reach
    move = reach if way > 0.0 else -reach
    s[0] += move
    return s[0] - 0.5 * move


def soft(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``ẏ = r tanh((x − y)/(r τ))``: a lag that cannot be faster than r.

    With ``v = (x − y)/(rτ)``: ``sinh v₁ = sinh v exp(−h/τ)``, and the integral of ``x − y`` is
    ``rτ² ∫ v coth v dv`` from v₁ to v, where ``v coth v = v + 2v/(exp 2v − 1)``. The last term is
    integrated by Gauss' rule.

    p: r, τ; s: y.
    """
    if h == 0.0:
        return s[0]
    scale = p[0] * p[1]
    v = abs(x - s[0]) / scale
    if v > _STEEP:
        left = v - h / p[1]
        after = left if left > _STEEP else np.arcsinh(0.5 * np.exp(left))
    else:
        after = np.arcsinh(np.sinh(v) * np.exp(-h / p[1]))
    area = 0.5 * (v - after) * (v + after)
    for k in range(_PANELS):
        low, high = max(after, _PANEL_ENDS[k]), min(v, _PANEL_ENDS[k + 1])
        if high > low:
            mid, half = 0.5 * (low + high), 0.5 * (high - low)
            u0, u2 = mid - _NODE * half, mid + _NODE * half
            total = 5.0 * u0 / np.expm1(2.0 * u0) + 8.0 * mid / np.expm1(2.0 * mid)
            area += 2.0 / 9.0 * half * (total + 5.0 * u2 / np.expm1(2.0 * u2))
    mean, gap = scale * p[1] / h * area, scale * after
    forward = x > s[0]
    s[0] = x - gap if forward else x + gap
    return x - mean if forward else x + mean


RATE = Parameter("rate", "r, maximum rate; current over capacitance", "u/s", 0.1, 1e6, 100.0,
                 per="input_span")  # fmt: skip
_TRAITS = frozenset({Trait.TRANSIENT, Trait.MEMORYLESS})

_AT_ONCE_S = 5e-4  # over which an axis may be asked to go all its way


def _slower_than_asked(_values: Values, facts: Facts, bounds: Interval, extent: Extent) -> Interval:
    """Return rates, in inputs per second, the largest of which hardly any motion requests.

    Above it there is no limit: a soft one that never acts would look like a lag.
    """
    low, high = bounds
    asked = (extent.reach[1] - extent.reach[0]) / facts.gain / _AT_ONCE_S
    return low, max(min(high, asked), 2.0 * low)


SLEW_LIMIT = Effect(
    id="slew_limit",
    title="Slew limit",
    summary="Limits only large, fast motion, which becomes a triangle.",
    stage=Stage.ELECTRONICS,
    kinds=frozenset({"piezo"}),
    identification=Identification(
        starts=sizes(rate=(10.0, 3.0, 1.0, 0.3, 0.1, 0.03)), domain={"rate": _slower_than_asked}
    ),
    formulations=(
        Formulation(
            name="hard",
            equation="ẏ = r sign(x − y) until y = x",
            source="Fleming and Leang, Design, Modeling and Control of Nanopositioning Systems "
            "(2014), ch. 14",
            parameters=(RATE,),
            acts=Drive(step=hard, states=1, timed=True),
            inner_step_s=inner_step,
            traits=_TRAITS,
        ),
        Formulation(
            name="soft",
            equation="ẏ = r tanh((x − y)/(r τ))",
            source="Gray, Hurst, Lewis, Meyer, Analysis and Design of Analog Integrated Circuits, "
            "5th ed. (2009), ch. 9.6: an emitter-coupled pair charges a capacitor",
            parameters=(
                RATE,
                Parameter("time_constant", "τ, for small changes", "s", 1e-9, 0.1, 3e-4),
            ),
            acts=Drive(step=soft, states=1, timed=True),
            inner_step_s=inner_step,
            traits=_TRAITS,
        ),
    ),
)
