"""Lead of a reference that cancels the lag of a sampled axis.

A command that is held and an axis with poles z₁, z₂ make of a reference, with q = z⁻¹,

    y = q^d (β₁ q + β₂ q²) / ((1 − z₁ q)(1 − z₂ q)) · (1 − z₁)(1 − z₂) r,   β₁ + β₂ = 1

The lead ``F(q) E(q)`` takes the poles off exactly, so that no reference makes the axis ring
(zeros at the poles, as an input shaper has: Singh, "Optimal Reference Shaping for Dynamical
Systems" (2010), ch. 2), and the delay that is left to first order in 1 − q, so that it follows
positions and ramps without error::

    F = (1 − z₁ q)(1 − z₂ q) / ((1 − z₁)(1 − z₂))
    E = 1 + τ (1 − q),   τ = Σ βₘ (m + d)

A second order of E would make the output jump three times as far at every corner.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Axis


def lead_taps(axis: Axis, interval_s: float, *, delay: int = 0) -> FloatArray:
    """Return the weights (t,) of the present sample of a reference and those before it.

    The axis is taken as its robot file has it, by itself; ``delay`` intervals are the loop's.
    """
    poles, shares = _sampled(axis, interval_s)
    late = float(shares @ (delay + np.arange(1.0, len(shares) + 1.0)))
    flat = np.atleast_1d(np.real(np.poly(poles)))  # (1 − z₁ q)(1 − z₂ q)
    return np.convolve(flat / flat.sum(), np.array([1.0 + late, -late]))


def _sampled(axis: Axis, interval_s: float) -> tuple[np.ndarray, FloatArray]:
    """Return the poles in z, and β."""
    inertia = axis.inertia
    if inertia is None or inertia.stiffness == 0.0:
        return np.zeros(0), np.ones(1)
    rate2, damping = inertia.stiffness / inertia.mass, inertia.damping / inertia.mass
    roots = np.roots([1.0, damping, rate2]).astype(complex)
    poles = np.exp(roots * interval_s)
    # Response to a held step after one interval: 1 − (s₂ z₁ − s₁ z₂)/(s₂ − s₁).
    first, second = roots
    if abs(second - first) < 1e-9 * abs(first):  # critically damped
        left = poles[0] * (1.0 - roots[0] * interval_s)
    else:
        left = (second * poles[0] - first * poles[1]) / (second - first)
    begun = float((1.0 - left).real) / float(np.real(np.poly(poles)).sum())
    return poles, np.array([begun, 1.0 - begun])
