"""Closed-form solutions of thin round plates.

S. P. Timoshenko, S. Woinowsky-Krieger, *Theory of Plates and Shells*, 2nd ed. (1959), arts. 16-19
and 63; A. W. Leissa, *Vibration of Plates*, NASA SP-160 (1969), 2.1.
"""

from itertools import pairwise
from math import log, pi

import numpy as np
from scipy.optimize import brentq
from scipy.special import iv, ivp, jv, jvp

from rotemina.sim.arrays import FloatArray


def compute_axial_stiffness(rigidity: float, rim_radius: float, hub_radius: float) -> float:
    """Return the axial stiffness of a rigid hub, force over displacement, N/m.

    ``w = c1 + c2 r² + c3 ln r + c4 r² ln r``, clamped at the rim, level at the hub. The force is
    ``8 π D c4``. Radii are in units of the rim radius.
    """
    k = hub_radius / rim_radius
    conditions = [
        [1.0, 1.0, 0.0, 0.0],
        [0.0, 2.0, 1.0, 1.0],
        [1.0, k**2, log(k), k**2 * log(k)],
        [0.0, 2.0 * k, 1.0 / k, 2.0 * k * log(k) + k],
    ]
    strength = np.linalg.solve(conditions, [0.0, 0.0, 1.0, 0.0])[3]
    return float(8.0 * pi * rigidity * strength / rim_radius**2)


def compute_tilt_stiffness(rigidity: float, rim_radius: float, hub_radius: float) -> float:
    """Return the tilt stiffness of a rigid hub, moment over angle, N m/rad.

    ``w = (c1 r + c2 r³ + c3 / r + c4 r ln r) cos φ``, clamped at the rim, a plane at the hub. The
    moment is ``−4 π D c4``.
    """
    k = hub_radius / rim_radius
    conditions = [
        [1.0, 1.0, 1.0, 0.0],
        [1.0, 3.0, -1.0, 1.0],
        [k, k**3, 1.0 / k, k * log(k)],
        [1.0, 3.0 * k**2, -1.0 / k**2, log(k) + 1.0],
    ]
    strength = np.linalg.solve(conditions, [0.0, 0.0, k, 1.0])[3]
    return float(-4.0 * pi * rigidity * strength)


def compute_centre_load_deflection(
    rigidity: float, rim_radius: float, radius: FloatArray
) -> FloatArray:
    """Return the deflection w per force of a clamped plate without hub, force at its centre, m/N.

    ``w = (2 r² ln(r/a) + a² − r²) / (16 π D)``.
    """
    ratio = np.maximum(radius / rim_radius, 1e-300)
    shape = 2.0 * ratio**2 * np.log(ratio) + 1.0 - ratio**2
    return np.asarray(rim_radius**2 * shape / (16.0 * pi * rigidity))


def compute_centre_moment_deflection(
    rigidity: float, rim_radius: float, radius: FloatArray
) -> FloatArray:
    """Return w / cos φ per moment of a clamped plate without hub, moment at its centre, 1/N.

    ``w = r (ln(a/r) − ½ + r² / (2 a²)) / (4 π D)`` is the derivative along φ = 0 of the deflection
    by a force, with the terms r and r³ that clamp the rim.
    """
    ratio = np.maximum(radius / rim_radius, 1e-300)
    shape = ratio * (-np.log(ratio) - 0.5 + 0.5 * ratio**2)
    return np.asarray(rim_radius * shape / (4.0 * pi * rigidity))


def compute_frequencies_hz(
    rigidity: float, rim_radius: float, areal_mass: float, count: int
) -> list[tuple[int, float]]:
    """Return nodal diameters and frequency, Hz, of the modes of a clamped plate, slowest first.

    ``J_n(λ) I_n'(λ) − I_n(λ) J_n'(λ) = 0`` and ``ω = λ² √(D / (ρ h a⁴))``. A mode with nodal
    diameters exists twice but is listed once.
    """

    def compute_characteristic(value: float, n: int) -> float:
        determinant = jv(n, value) * ivp(n, value) - iv(n, value) * jvp(n, value)
        return float(determinant / iv(n, value))

    grid = np.linspace(0.5, 3.0 + 2.0 * count, 100 * (count + 2))
    roots = [
        (n, brentq(compute_characteristic, low, high, args=(n,), xtol=1e-13))
        for n in range(count + 2)
        for low, high in pairwise(grid)
        if compute_characteristic(low, n) * compute_characteristic(high, n) < 0.0
    ]
    unit = np.sqrt(rigidity / areal_mass) / rim_radius**2 / (2.0 * pi)
    return [(n, float(unit * value**2)) for n, value in sorted(roots, key=lambda root: root[1])][
        :count
    ]
