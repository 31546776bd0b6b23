"""Coulomb friction in the seat of the pin, which sticks inside a limit surface and slips on it.

The seat carries ``f = (N, Mx, My)`` while ``(N / N_max)² + (Mx² + My²) / M_max² ≤ 1`` with
``N_max = μ P`` and ``M_max = N_max · arm``. It slips along the normal of this surface, which is the
direction of maximum dissipation.

Source: S. Goyal, A. Ruina, J. Papadopoulos, "Planar sliding with dry friction", Wear 143 (1991)
(limit surface); R. D. Howe, M. R. Cutkosky, Int. J. Robot. Res. 15 (1996) (ellipsoid);
J. C. Simo, T. J. R. Hughes, *Computational Inelasticity* (1998), ch. 3 (return mapping).
"""

from typing import NamedTuple

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot import PinJoint


class SeatForce(NamedTuple):
    """Force and moments that the seat carries (N, N m, N m), and slip in this step (m, rad)."""

    force: FloatArray
    slip: FloatArray


def friction_limits(joint: PinJoint) -> FloatArray:
    """Return the largest axial force and the largest moments, each acting alone: N, N m, N m."""
    force = joint.friction * joint.clamp_force
    return np.array([force, force * joint.arm, force * joint.arm])


def friction_utilization(joint: PinJoint, force: FloatArray) -> float:
    """Return the share of the friction that a force uses; the seat slips at 1."""
    return float(np.linalg.norm(force / friction_limits(joint)))


def solve_seat_force(joint: PinJoint, stiffness: FloatArray, trial: FloatArray) -> SeatForce:
    """Return force and slip of the seat from the force that would act if the pin stuck.

    With ``Q = diag(1 / limit²)`` the slip is ``λ Q f``, and ``f = trial − K λ Q f``. This is one
    equation for λ, which is solved in the axes in which K and Q are both diagonal.

    Parameters
    ----------
    joint : PinJoint
    stiffness : (3, 3) array
        Stiffness K of plate and pin in series.
    trial : (3,) array
        Force and moments without slip.
    """
    if friction_utilization(joint, trial) <= 1.0:
        return SeatForce(trial, np.zeros(3))
    quadric = np.diag(1.0 / friction_limits(joint) ** 2)
    # With V from Q v = s K⁻¹ v, Vᵀ K⁻¹ V = 1: V⁻¹ (1 + λ K Q) V = diag(1 + λ s).
    eigenvalues, axes = scipy.linalg.eigh(quadric, np.linalg.inv(stiffness))
    components = np.linalg.solve(axes, trial)

    def compute_excess(multiplier: float) -> float:
        return float(
            np.sum(eigenvalues * (components / (1.0 + multiplier * eigenvalues)) ** 2) - 1.0
        )

    high = 1.0 / eigenvalues.max()
    while compute_excess(high) > 0.0:
        high *= 2.0
    multiplier = scipy.optimize.brentq(compute_excess, 0.0, high, xtol=1e-15 * high, rtol=1e-14)
    force = axes @ (components / (1.0 + multiplier * eigenvalues))
    return SeatForce(force, multiplier * (quadric @ force))
