"""Modes of a linear system with several inputs, by vector fitting of sampled spectra.

Gustavsen and Semlyen, IEEE Trans. Power Delivery 14 (1999) 1052-1061, in its relaxed form
(Gustavsen, IEEE Trans. Power Delivery 21 (2006) 1587-1592), on the unit circle. The model is
``Y = Σ_j X_j Σ_k (a_jk / (z − λ_k) + ā_jk / (z − λ̄_k))``, with one set of poles for all inputs.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray

# Largest imaginary part of a pole that counts as real.
_MAX_REAL_POLE_IMAGINARY = 1e-9
# Imaginary part of the complex pair that replaces two real poles.
_RESTART_IMAGINARY = 0.05
# Frequency of the fastest start pole, as a share of the highest frequency of the lines.
_MAX_START_FREQUENCY_RATIO = 0.98
# Damping ratio of the start poles.
_START_DAMPING_RATIO = 0.01
# Smallest modulus of the weight at infinity, by which the weighting is divided.
_MIN_WEIGHT_AT_INFINITY = 1e-8


@dataclass(frozen=True, eq=False)
class InputOutputSpectra:
    """Spectra of the inputs and one output of a system, on the same lines in every record.

    Attributes
    ----------
    z : (lines,)
        Points of the lines on the unit circle.
    inputs : (records, inputs, lines)
    output : (records, lines)
    """

    z: ComplexArray
    inputs: ComplexArray
    output: ComplexArray

    @classmethod
    def from_records(cls, z: ComplexArray, inputs: ComplexArray, output: ComplexArray) -> Self:
        """Return spectra of records, combined into fewer records if there are many.

        At each line the records are rows of ``[inputs, output]``. A least-squares problem depends
        on these rows only through the triangle of their QR decomposition, which replaces them.
        """
        rows = np.concatenate([inputs, output[:, None]], axis=1).transpose(2, 0, 1)
        if rows.shape[1] > rows.shape[2]:
            rows = np.asarray(np.linalg.qr(rows, mode="r"))
        combined = rows.transpose(1, 2, 0)
        return cls(z, combined[:, :-1], combined[:, -1])

    def select_inputs(self, inputs: Sequence[int]) -> "InputOutputSpectra":
        """Return the spectra with only some of the inputs."""
        return InputOutputSpectra(self.z, self.inputs[:, list(inputs)], self.output)


def make_start_poles(z: ComplexArray, pairs: int) -> ComplexArray:
    """Return lightly damped poles (pairs,) spread evenly over the lines' frequencies, rad."""
    line_angles = np.abs(np.angle(z))
    max_angle = _MAX_START_FREQUENCY_RATIO * line_angles.max()
    angles = np.linspace(
        max(line_angles.min(), (1.0 - _MAX_START_FREQUENCY_RATIO) * max_angle), max_angle, pairs
    )
    return np.asarray(np.exp((1j - _START_DAMPING_RATIO) * angles))


def relocate_poles(
    spectra: InputOutputSpectra, poles: ComplexArray, max_modulus: float
) -> ComplexArray:
    """Return improved poles: the zeros of the weighting function that makes the fit linear.

    Parameters
    ----------
    spectra : InputOutputSpectra
    poles : (pairs,)
        Poles above the real axis.
    max_modulus : float
        Largest modulus of a pole, below 1. A mode that rings longer than a record cannot be
        distinguished from a line of noise.

    Returns
    -------
    (pairs,)
        One pole fewer if an odd number of them became real.
    """
    basis = _make_basis(spectra.z, poles)
    count = basis.shape[1]
    rows = [
        np.hstack([*(basis * x[:, None] for x in inputs), -basis * y[:, None], -y[:, None]])
        for inputs, y in zip(spectra.inputs, spectra.output, strict=True)
    ]
    matrix = _stack_parts(np.vstack(rows))
    column_norms = np.linalg.norm(matrix, axis=0)
    first_weight_column = matrix.shape[1] - count - 1
    triangle = np.asarray(np.linalg.qr(matrix / column_norms, mode="r"))[
        first_weight_column:, first_weight_column:
    ]
    # Relaxed vector fitting: the weighting is 1 on average instead of 1 at infinity.
    line_count = len(spectra.z)
    mean_row = (
        np.concatenate([basis.real.sum(axis=0), [float(line_count)]])
        / column_norms[first_weight_column:]
    )
    constraint_weight = float(np.linalg.norm(spectra.output)) / line_count
    equations = np.vstack([triangle, constraint_weight * mean_row])
    right_side = np.zeros(len(equations))
    right_side[-1] = constraint_weight * line_count
    solution = np.linalg.lstsq(equations, right_side)[0] / column_norms[first_weight_column:]
    weight_at_infinity = (
        solution[-1] if abs(solution[-1]) > _MIN_WEIGHT_AT_INFINITY else _MIN_WEIGHT_AT_INFINITY
    )
    weights = solution[:-1] / weight_at_infinity
    companion = np.zeros((count, count))
    input_vector = np.zeros(count)
    for k, pole in enumerate(poles):
        block = slice(2 * k, 2 * k + 2)
        companion[block, block] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
        input_vector[2 * k] = 2.0
    zeros = np.asarray(
        np.linalg.eigvals(companion - np.outer(input_vector, weights)), np.complex128
    )
    return _stabilise_poles(zeros, max_modulus)


def pole_contributions(
    spectra: InputOutputSpectra, poles: ComplexArray
) -> tuple[float, FloatArray]:
    """Return the residual sum of squares, and its growth (pairs,) without each pole.

    When a pole is left out, the others stay where they are and only their residues change.
    """
    reduced = _reduce_problem(spectra, poles)
    residual, growth = _compute_residual_growth(
        reduced.design, reduced.output, spectra.inputs.shape[1]
    )
    return reduced.unexplained + residual, growth


def fit_poles(
    spectra: InputOutputSpectra, pairs: int, max_modulus: float, *, max_poles: int
) -> ComplexArray:
    """Return the poles that explain an output best, above the real axis, at most ``max_poles``.

    The fit begins with more poles, ``pairs``, and drops those that contribute least.
    """
    poles = make_start_poles(spectra.z, pairs)
    for _ in range(8):
        poles = relocate_poles(spectra, poles, max_modulus)
    return reduce_poles(spectra, poles, max_modulus, max_poles=max_poles)


def reduce_poles(
    spectra: InputOutputSpectra, poles: ComplexArray, max_modulus: float, *, max_poles: int
) -> ComplexArray:
    """Drop the least important poles (pairs,) until ``max_poles`` are left, and relocate these.

    ``max_modulus`` is as for :func:`relocate_poles`.
    """
    design, output, _ = _reduce_problem(spectra, poles)
    inputs = spectra.inputs.shape[1]
    while len(poles) > max_poles:
        weakest = int(np.argmin(_compute_residual_growth(design, output, inputs)[1]))
        design = np.delete(design, _columns_of_pair(weakest, len(poles), inputs), axis=1)
        poles = np.delete(poles, weakest)
    for _ in range(3):
        poles = relocate_poles(spectra, poles, max_modulus)
    return poles


class _ReducedProblem(NamedTuple):
    """A least-squares problem projected onto the column space of its design matrix.

    ``design`` is a triangle, ``output`` the projected output, and ``unexplained`` the sum of
    squares of the output outside that space.
    """

    design: FloatArray
    output: FloatArray
    unexplained: float


def _reduce_problem(spectra: InputOutputSpectra, poles: ComplexArray) -> _ReducedProblem:
    design, output = _make_design(spectra, poles)
    q, r = np.linalg.qr(design / np.linalg.norm(design, axis=0))
    projected = q.T @ output
    return _ReducedProblem(r, projected, float(np.sum((output - q @ projected) ** 2)))


def _compute_residual_growth(
    design: FloatArray, output: FloatArray, inputs: int
) -> tuple[float, FloatArray]:
    """Return the residual sum of squares of a design (n, columns) and its growth (pairs,).

    The growth is given for each pair of poles: by how much the sum increases without it.
    """
    q, r = np.linalg.qr(design)
    coefficients = np.linalg.solve(r, q.T @ output)
    inverse = np.linalg.inv(r)
    covariance = inverse @ inverse.T
    pairs = design.shape[1] // (2 * inputs)
    growth = np.empty(pairs)
    for k in range(pairs):
        columns = _columns_of_pair(k, pairs, inputs)
        theta = coefficients[columns]
        growth[k] = theta @ np.linalg.solve(covariance[np.ix_(columns, columns)], theta)
    return float(np.sum((output - design @ coefficients) ** 2)), growth


def _columns_of_pair(pair: int, pairs: int, inputs: int) -> list[int]:
    return [2 * (j * pairs + pair) + part for j in range(inputs) for part in (0, 1)]


def _make_design(spectra: InputOutputSpectra, poles: ComplexArray) -> tuple[FloatArray, FloatArray]:
    basis = _make_basis(spectra.z, poles)
    rows = [np.hstack([basis * x[:, None] for x in inputs]) for inputs in spectra.inputs]
    return _stack_parts(np.vstack(rows)), _stack_parts(spectra.output.ravel())


def _make_basis(z: ComplexArray, poles: ComplexArray) -> ComplexArray:
    """Return two basis functions for each pair of poles, (lines, 2 pairs).

    Their coefficients are real.
    """
    upper, lower = 1.0 / (z[:, None] - poles), 1.0 / (z[:, None] - poles.conj())
    functions = np.stack([upper + lower, 1j * (upper - lower)], axis=2)
    return np.asarray(functions.reshape(len(z), -1))


def _stack_parts(values: ComplexArray) -> FloatArray:
    """Return the real parts followed by the imaginary parts."""
    return np.concatenate([values.real, values.imag])


def _stabilise_poles(poles: ComplexArray, max_modulus: float) -> ComplexArray:
    """Return the poles above the real axis, with unstable ones mirrored and real ones paired."""
    modulus = np.abs(poles)
    poles = np.where(modulus > 1.0, 1.0 / poles.conj(), poles)
    modulus = np.abs(poles)
    poles = np.where(
        modulus > max_modulus, poles * max_modulus / np.maximum(modulus, max_modulus), poles
    )
    complex_poles = poles[poles.imag > _MAX_REAL_POLE_IMAGINARY]
    real_poles = np.sort(poles[np.abs(poles.imag) <= _MAX_REAL_POLE_IMAGINARY].real)
    pairs = [
        complex(real_poles[k : k + 2].mean(), _RESTART_IMAGINARY)
        for k in range(0, len(real_poles) - 1, 2)
    ]
    return np.array(sorted([*complex_poles, *pairs], key=np.angle))
