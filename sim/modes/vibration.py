"""Natural frequencies, damping ratios and shapes of a machine's modes.

``A s = λ s`` of the first-order form with ``s = [φ, λ φ]``; a pair of complex λ is one mode with
``ω = |λ|``, ``ζ = −Re λ / |λ|``.
Source: Ewins, "Modal Testing", 2nd ed. (2000), ch. 2.

Axes that no coupling joins are solved apart, so equal frequencies of two axes never mix.

Shapes are mass-normalised, ``φᴴ M φ = 1``: lengths in kg^−½, angles in rad kg^−½ m⁻¹.
Sign: the axis that carries most of the mode, by ``M_ii |φ_i|²``, is real and positive; of equal
ones the first.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.plant.coupled_groups import groups_of
from rotemina.sim.robot.matrices import InertiaMatrices, inertia_matrices
from rotemina.sim.robot.model import Robot

# Rounding moves a double pole at zero by the square root of float64's precision.
_DOUBLE_POLE_SHARE = 1e-7
_SINGULAR = 1e-12  # eigenvalue of a stiffness scaled to a unit diagonal that counts as zero
_EQUAL = 1e-9  # relative difference by which rounding may part equal axes of a mode


@dataclass(frozen=True, slots=True, eq=False)
class DampedModes:
    """Modes with damping, by rising frequency; p of them for m axes.

    A mode is a complex pair of poles, or a single real pole: an overdamped axis has two of them,
    each with damping ratio 1 (−1 if it grows). A pole at zero has frequency 0 and ratio NaN.

    Attributes
    ----------
    axes : tuple of str, length m
    poles : (p,) complex
        1/s, the one with the positive imaginary part of each pair.
    frequency_hz, damping_ratio : (p,)
        ``|λ|/2π``, and ``−Re λ/|λ|``.
    shapes : (m, p) complex
    dominant : tuple of str, length p
    """

    axes: tuple[str, ...]
    poles: ComplexArray
    frequency_hz: FloatArray
    damping_ratio: FloatArray
    shapes: ComplexArray
    dominant: tuple[str, ...]


def damped_modes(robot: Robot) -> DampedModes:
    """Return the modes of ``robot`` with D."""
    whole = inertia_matrices(robot)
    poles: list[complex] = []
    columns: list[ComplexArray] = []
    for members, part in _parts(robot, whole):
        own, vectors = _eigen(part)
        for k in np.flatnonzero(own.imag >= 0.0):
            poles.append(complex(own[k]))
            columns.append(np.zeros(len(whole.axes), dtype=np.complex128))
            columns[-1][members] = vectors[:, k]
    found = np.array(poles, dtype=np.complex128)
    order = np.argsort(np.abs(found), kind="stable")
    shapes = np.array(columns, dtype=np.complex128).reshape(len(found), len(whole.axes)).T
    normal, dominant = _normalised(whole, shapes[:, order])
    found = found[order]
    size = np.abs(found)
    ratio = np.full(len(found), np.nan)
    np.divide(-found.real, size, out=ratio, where=size > 0.0)
    return DampedModes(whole.axes, found, size / (2.0 * np.pi), ratio, normal, dominant)


def poles_of(robot: Robot) -> dict[tuple[str, ...], ComplexArray]:
    """Return all 2m poles, 1/s, of each group of m coupled axes; rigid motions exactly 0."""
    whole = inertia_matrices(robot)
    return {part.axes: _eigen(part)[0] for _, part in _parts(robot, whole)}


def _parts(robot: Robot, whole: InertiaMatrices) -> Iterator[tuple[list[int], InertiaMatrices]]:
    """Yield the places and matrices of each group of coupled axes."""
    for group in groups_of(robot):
        members = [whole.axes.index(name) for name in group.axes]
        block = np.ix_(members, members)
        matrices = (matrix[block] for matrix in whole[1:])
        yield members, InertiaMatrices(group.axes, *matrices)


def _eigen(part: InertiaMatrices) -> tuple[ComplexArray, ComplexArray]:
    """Solve ``A s = λ s`` of one group: poles (2m,), positions of the vectors (m, 2m)."""
    m = len(part.axes)
    a = np.zeros((2 * m, 2 * m))
    a[:m, m:] = np.eye(m)
    a[m:] = -np.linalg.solve(part.mass, np.hstack([part.stiffness, part.damping]))
    poles, vectors = np.linalg.eig(a)
    order = np.argsort(np.abs(poles), kind="stable")
    poles, vectors = poles[order].astype(np.complex128), vectors[:m, order]
    free, edge = _free_motions(part), _DOUBLE_POLE_SHARE * float(np.abs(poles[-1]))
    poles[:free] = 0.0
    poles[: 2 * free][np.abs(poles[: 2 * free]) <= edge] = 0.0
    return poles, vectors.astype(np.complex128)


def _free_motions(part: InertiaMatrices) -> int:
    """Return in how many ways a group can move without bending a spring."""
    diagonal = np.diag(part.stiffness)
    scale = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    return int((np.linalg.eigvalsh(part.stiffness * np.outer(scale, scale)) <= _SINGULAR).sum())


def _normalised(
    whole: InertiaMatrices, shapes: ComplexArray
) -> tuple[ComplexArray, tuple[str, ...]]:
    """Scale each column to unit modal mass and turn it real and positive where it is strongest."""
    if not whole.axes:
        return shapes, ()
    modal_mass = np.einsum("ik,ij,jk->k", shapes.conj(), whole.mass, shapes).real
    carried = np.diag(whole.mass)[:, None] * np.abs(shapes) ** 2
    strongest = np.argmax(carried >= (1.0 - _EQUAL) * carried.max(axis=0), axis=0)
    lead = shapes[strongest, np.arange(shapes.shape[1])].astype(np.complex128)
    turned: ComplexArray = shapes * (np.abs(lead) / lead / np.sqrt(modal_mass)) + 0.0
    return turned, tuple(whole.axes[i] for i in strongest)
