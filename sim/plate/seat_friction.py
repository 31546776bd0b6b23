"""Coulomb friction in the pin's seat: it sticks inside a limit surface and slips on it.

The seat carries ``f = (N, Mx, My)`` as long as ``(N / N_max)² + (Mx² + My²) / M_max² ≤ 1`` with
``N_max = μ P`` and ``M_max = N_max · arm``. It slips along the surface's normal, which is the
direction of the greatest dissipation.

Source: S. Goyal, A. Ruina, J. Papadopoulos, "Planar sliding with dry friction", Wear 143 (1991)
(limit surface); R. D. Howe, M. R. Cutkosky, Int. J. Robot. Res. 15 (1996) (ellipsoid);
J. C. Simo, T. J. R. Hughes, *Computational Inelasticity* (1998), ch. 3 (return mapping).
"""

from typing import NamedTuple

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.plate import Joint


class SeatForce(NamedTuple):
    """What the seat carries (N, N m, N m), and how far the pin slipped in this step (m, rad)."""

    force: FloatArray
    slip: FloatArray


def limits(joint: Joint) -> FloatArray:
    """Return the largest force along the pin and the largest moments, each alone: N, N m, N m."""
    force = joint.friction * joint.clamp_force
    return np.array([force, force * joint.arm, force * joint.arm])


def utilization(joint: Joint, force: FloatArray) -> float:
    """Return how much of the friction a force takes: 1 is where the seat slips."""
    return float(np.linalg.norm(force / limits(joint)))


def seat_force(joint: Joint, stiffness: FloatArray, trial: FloatArray) -> SeatForce:
    """Return the force after slip, for the force that there were if the seat stuck.

    With ``Q = diag(1 / limit²)``, slip ``λ Q f`` and ``f = trial − K λ Q f``: one equation for λ,
    solved in the axes in which K and Q are both diagonal.

    Parameters
    ----------
    stiffness : (3, 3) array
        K, of plate and pin in series.
    trial : (3,) array
    """
    if utilization(joint, trial) <= 1.0:
        return SeatForce(trial, np.zeros(3))
    quadric = np.diag(1.0 / limits(joint) ** 2)
    # With V from Q v = s K⁻¹ v, Vᵀ K⁻¹ V = 1: V⁻¹ (1 + λ K Q) V = diag(1 + λ s).
    shares, axes = scipy.linalg.eigh(quadric, np.linalg.inv(stiffness))
    parts = np.linalg.solve(axes, trial)

    def outside(slip: float) -> float:
        return float(np.sum(shares * (parts / (1.0 + slip * shares)) ** 2) - 1.0)

    high = 1.0 / shares.max()
    while outside(high) > 0.0:
        high *= 2.0
    slip = scipy.optimize.brentq(outside, 0.0, high, xtol=1e-15 * high, rtol=1e-14)
    force = axes @ (parts / (1.0 + slip * shares))
    return SeatForce(force, slip * (quadric @ force))
