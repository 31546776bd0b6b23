"""Natural frequencies, damping ratios and shapes of a machine's modes.

They follow from ``A s = λ s`` of the first-order form with ``s = [φ, λ φ]``. A pair of complex λ is
one mode with ``ω = |λ|``, ``ζ = −Re λ / |λ|``.
Source: Ewins, "Modal Testing", 2nd ed. (2000), ch. 2.

Groups of axes without a coupling between them are solved separately, so equal frequencies of two
axes never mix.

Shapes are mass-normalised, ``φᴴ M φ = 1``: lengths in kg^−½, angles in rad kg^−½ m⁻¹.
Their phase is such that the dominant axis, that with the largest ``M_ii |φ_i|²``, is real and
positive. If several axes are equal, the first one is dominant.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.plant import make_groups
from rotemina.sim.robot import InertiaMatrices, Robot, assemble_inertia_matrices

# Largest modulus of a pole at zero, as a share of the largest pole. Rounding moves a double pole at
# zero by the square root of the precision of float64.
_MAX_ZERO_POLE_RATIO = 1e-7
# Largest zero eigenvalue of a stiffness matrix that is scaled to a unit diagonal.
_MAX_ZERO_EIGENVALUE = 1e-12
# Relative difference by which rounding may separate axes that contribute equally to a mode.
_EQUALITY_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class DampedModes:
    """The p damped modes of m axes, in order of rising frequency.

    A mode is a complex pair of poles or a single real pole. An overdamped axis has two real poles,
    each with damping ratio 1 (−1 if unstable). A pole at zero has frequency 0 and ratio NaN.

    Attributes
    ----------
    axes : tuple of str, length m
    poles : (p,) complex
        1/s; of each pair, the pole with the positive imaginary part.
    frequency_hz, damping_ratio : (p,)
        ``|λ|/2π`` and ``−Re λ/|λ|``.
    shapes : (m, p) complex
    dominant : tuple of str, length p
        The dominant axis of each mode.
    """

    axes: tuple[str, ...]
    poles: ComplexArray
    frequency_hz: FloatArray
    damping_ratio: FloatArray
    shapes: ComplexArray
    dominant: tuple[str, ...]


def compute_damped_modes(robot: Robot) -> DampedModes:
    """Return the damped modes of ``robot``."""
    matrices = assemble_inertia_matrices(robot)
    poles: list[complex] = []
    columns: list[ComplexArray] = []
    for members, group_matrices in _split_groups(robot, matrices):
        group_poles, vectors = _solve_eigenproblem(group_matrices)
        for k in np.flatnonzero(group_poles.imag >= 0.0):
            poles.append(complex(group_poles[k]))
            columns.append(np.zeros(len(matrices.axes), dtype=np.complex128))
            columns[-1][members] = vectors[:, k]
    pole_values = np.array(poles, dtype=np.complex128)
    order = np.argsort(np.abs(pole_values), kind="stable")
    shapes = np.array(columns, dtype=np.complex128).reshape(len(pole_values), len(matrices.axes)).T
    normalised_shapes, dominant = _normalise_shapes(matrices, shapes[:, order])
    pole_values = pole_values[order]
    modulus = np.abs(pole_values)
    damping_ratio = np.full(len(pole_values), np.nan)
    np.divide(-pole_values.real, modulus, out=damping_ratio, where=modulus > 0.0)
    return DampedModes(
        matrices.axes,
        pole_values,
        modulus / (2.0 * np.pi),
        damping_ratio,
        normalised_shapes,
        dominant,
    )


def compute_poles(robot: Robot) -> dict[tuple[str, ...], ComplexArray]:
    """Return the 2m poles, 1/s, of each group of m coupled axes; those of free motions are 0."""
    matrices = assemble_inertia_matrices(robot)
    return {
        group_matrices.axes: _solve_eigenproblem(group_matrices)[0]
        for _, group_matrices in _split_groups(robot, matrices)
    }


def _split_groups(
    robot: Robot, matrices: InertiaMatrices
) -> Iterator[tuple[list[int], InertiaMatrices]]:
    for group in make_groups(robot):
        members = [matrices.axes.index(name) for name in group.axes]
        block = np.ix_(members, members)
        group_matrices = (matrix[block] for matrix in matrices[1:])
        yield members, InertiaMatrices(group.axes, *group_matrices)


def _solve_eigenproblem(matrices: InertiaMatrices) -> tuple[ComplexArray, ComplexArray]:
    """Solve ``A s = λ s`` of one group.

    Return the poles (2m,) and the position part of the eigenvectors (m, 2m).
    """
    m = len(matrices.axes)
    a = np.zeros((2 * m, 2 * m))
    a[:m, m:] = np.eye(m)
    a[m:] = -np.linalg.solve(matrices.mass, np.hstack([matrices.stiffness, matrices.damping]))
    poles, vectors = np.linalg.eig(a)
    order = np.argsort(np.abs(poles), kind="stable")
    poles, vectors = poles[order].astype(np.complex128), vectors[:m, order]
    # Each free motion has one pole at zero, and a second one if it has no damping.
    free_count, tolerance = (
        _count_free_motions(matrices),
        _MAX_ZERO_POLE_RATIO * float(np.abs(poles[-1])),
    )
    poles[:free_count] = 0.0
    poles[: 2 * free_count][np.abs(poles[: 2 * free_count]) <= tolerance] = 0.0
    return poles, vectors.astype(np.complex128)


def _count_free_motions(matrices: InertiaMatrices) -> int:
    """Return the number of independent motions of a group that load no spring."""
    diagonal = np.diag(matrices.stiffness)
    scale = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    return int(
        (
            np.linalg.eigvalsh(matrices.stiffness * np.outer(scale, scale)) <= _MAX_ZERO_EIGENVALUE
        ).sum()
    )


def _normalise_shapes(
    matrices: InertiaMatrices, shapes: ComplexArray
) -> tuple[ComplexArray, tuple[str, ...]]:
    """Scale each column to unit modal mass, with its dominant axis real and positive.

    Return the shapes (m, p) and the dominant axes.
    """
    if not matrices.axes:
        return shapes, ()
    modal_mass = np.einsum("ik,ij,jk->k", shapes.conj(), matrices.mass, shapes).real
    modal_share = np.diag(matrices.mass)[:, None] * np.abs(shapes) ** 2
    dominant = np.argmax(
        modal_share >= (1.0 - _EQUALITY_TOLERANCE) * modal_share.max(axis=0), axis=0
    )
    dominant_values = shapes[dominant, np.arange(shapes.shape[1])].astype(np.complex128)
    normalised: ComplexArray = (
        shapes * (np.abs(dominant_values) / dominant_values / np.sqrt(modal_mass)) + 0.0
    )
    return normalised, tuple(matrices.axes[i] for i in dominant)
