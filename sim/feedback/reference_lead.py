"""Lead of a reference that cancels the lag of a sampled axis.

With a held command and an axis with poles z₁, z₂, the response to a reference is, with q = z⁻¹,

    y = q^d (β₁ q + β₂ q²) / ((1 − z₁ q)(1 − z₂ q)) · (1 − z₁)(1 − z₂) r,   β₁ + β₂ = 1

The lead ``F(q) E(q)`` cancels the poles exactly, so that no reference makes the axis oscillate. It
has zeros at the poles, like an input shaper (Singh, "Optimal Reference Shaping for Dynamical
Systems" (2010), ch. 2). It cancels the remaining delay to first order in 1 − q, so that the axis
follows positions and ramps without error::

    F = (1 − z₁ q)(1 − z₂ q) / ((1 − z₁)(1 − z₂))
    E = 1 + τ (1 − q),   τ = Σ βₘ (m + d)

With an E of second order, the output would jump three times as far at every corner.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot import Axis


def compute_lead_taps(axis: Axis, interval_s: float, *, delay: int = 0) -> FloatArray:
    """Return the weights (t,) of the present sample of a reference and the previous ones.

    The axis is modelled as its robot file describes it, without coupling. ``delay`` is that of the
    loop, in intervals.
    """
    poles, weights = _sample_axis(axis, interval_s)
    tau = float(weights @ (delay + np.arange(1.0, len(weights) + 1.0)))
    # (1 − z₁ q)(1 − z₂ q)
    numerator = np.atleast_1d(np.real(np.poly(poles)))
    return np.convolve(numerator / numerator.sum(), np.array([1.0 + tau, -tau]))


def _sample_axis(axis: Axis, interval_s: float) -> tuple[np.ndarray, FloatArray]:
    """Return the poles (p,) in z, and the weights β (m,)."""
    inertia = axis.inertia
    if inertia is None or inertia.stiffness == 0.0:
        return np.zeros(0), np.ones(1)
    omega_squared, damping_rate = inertia.stiffness / inertia.mass, inertia.damping / inertia.mass
    roots = np.roots([1.0, damping_rate, omega_squared]).astype(complex)
    poles = np.exp(roots * interval_s)
    # The response to a held step after one interval is 1 − (s₂ z₁ − s₁ z₂)/(s₂ − s₁). Two equal
    # roots, of a critically damped axis, need the limit of that expression.
    first, second = roots
    if abs(second - first) < 1e-9 * abs(first):
        remaining_error = poles[0] * (1.0 - roots[0] * interval_s)
    else:
        remaining_error = (second * poles[0] - first * poles[1]) / (second - first)
    first_weight = float((1.0 - remaining_error).real) / float(np.real(np.poly(poles)).sum())
    return poles, np.array([first_weight, 1.0 - first_weight])
