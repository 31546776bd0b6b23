"""Modes of a linear system with several inputs, by vector fitting of sampled spectra.

Gustavsen and Semlyen, IEEE Trans. Power Delivery 14 (1999) 1052-1061, in its relaxed form
(Gustavsen, IEEE Trans. Power Delivery 21 (2006) 1587-1592), on the unit circle: the model is
``Y = Σ_j X_j Σ_k (a_jk / (z − λ_k) + ā_jk / (z − λ̄_k))``, one set of poles for all inputs.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray

_REAL = 1e-9  # of its imaginary part, below which a pole is real
_APART = 0.05  # imaginary part with which a pair of real poles begins anew
_FAR = 0.98  # of the highest frequency, up to which poles begin
_DAMPED = 0.01  # damping ratio with which they do
_TRIVIAL = 1e-8  # weight at infinity below which a weighting is none


@dataclass(frozen=True, eq=False)
class Spectra:
    """What a system answers to its inputs, at the same lines in every record.

    Attributes
    ----------
    z : (lines,)
        On the unit circle.
    inputs : (records, inputs, lines)
    output : (records, lines)
    """

    z: ComplexArray
    inputs: ComplexArray
    output: ComplexArray

    @classmethod
    def of(cls, z: ComplexArray, inputs: ComplexArray, output: ComplexArray) -> Self:
        """Gather spectra; more records than tell something new are put together.

        At each line the records are rows of ``[inputs, output]``, and a least-squares problem
        knows no more of them than the triangle of their QR decomposition.
        """
        rows = np.concatenate([inputs, output[:, None]], axis=1).transpose(2, 0, 1)
        if rows.shape[1] > rows.shape[2]:
            rows = np.asarray(np.linalg.qr(rows, mode="r"))
        together = rows.transpose(1, 2, 0)
        return cls(z, together[:, :-1], together[:, -1])

    def only(self, inputs: Sequence[int]) -> "Spectra":
        """Return the spectra with some of the inputs."""
        return Spectra(self.z, self.inputs[:, list(inputs)], self.output)


def first_poles(z: ComplexArray, pairs: int) -> ComplexArray:
    """Return lightly damped poles (pairs,) spread evenly over the lines' frequencies, rad."""
    angle = np.abs(np.angle(z))
    most = _FAR * angle.max()
    spread = np.linspace(max(angle.min(), (1.0 - _FAR) * most), most, pairs)
    return np.asarray(np.exp((1j - _DAMPED) * spread))


def relocated(spectra: Spectra, poles: ComplexArray, slowest: float) -> ComplexArray:
    """Return better poles: the zeros of the weighting that makes the fit a linear one.

    Parameters
    ----------
    spectra : Spectra
    poles : (pairs,)
        Above the real axis.
    slowest : float
        The greatest modulus that a pole may have, below 1: what rings on for longer than a record
        is a line of noise.

    Returns
    -------
    (pairs,)
        There may be one fewer, where an odd number became real.
    """
    basis = _basis(spectra.z, poles)
    count = basis.shape[1]
    rows = [
        np.hstack([*(basis * x[:, None] for x in inputs), -basis * y[:, None], -y[:, None]])
        for inputs, y in zip(spectra.inputs, spectra.output, strict=True)
    ]
    matrix = _parts(np.vstack(rows))
    size = np.linalg.norm(matrix, axis=0)
    own = matrix.shape[1] - count - 1
    triangle = np.asarray(np.linalg.qr(matrix / size, mode="r"))[own:, own:]
    # Relaxed: instead of being 1 at infinity the weighting is 1 on the average.
    lines = len(spectra.z)
    mean = np.concatenate([basis.real.sum(axis=0), [float(lines)]]) / size[own:]
    weight = float(np.linalg.norm(spectra.output)) / lines
    equations = np.vstack([triangle, weight * mean])
    right = np.zeros(len(equations))
    right[-1] = weight * lines
    found = np.linalg.lstsq(equations, right)[0] / size[own:]
    at_infinity = found[-1] if abs(found[-1]) > _TRIVIAL else _TRIVIAL
    weights = found[:-1] / at_infinity
    companion = np.zeros((count, count))
    reach = np.zeros(count)
    for k, pole in enumerate(poles):
        block = slice(2 * k, 2 * k + 2)
        companion[block, block] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
        reach[2 * k] = 2.0
    zeros = np.asarray(np.linalg.eigvals(companion - np.outer(reach, weights)), np.complex128)
    return _tamed(zeros, slowest)


def contributions(spectra: Spectra, poles: ComplexArray) -> tuple[float, FloatArray]:
    """Return the sum of squares that poles leave, and by how much it grows (pairs,) without each.

    The others keep their poles and change their residues.
    """
    reduced = _reduced(spectra, poles)
    left, grown = _grown(reduced.design, reduced.output, spectra.inputs.shape[1])
    return reduced.beyond + left, grown


def vector_fit(spectra: Spectra, pairs: int, slowest: float, *, most: int) -> ComplexArray:
    """Return the poles (up to ``most``,) that explain an output best, above the real axis.

    More of them, ``pairs``, are sought, and those that tell least are dropped.
    """
    poles = first_poles(spectra.z, pairs)
    for _ in range(8):
        poles = relocated(spectra, poles, slowest)
    return fewer(spectra, poles, slowest, most=most)


def fewer(spectra: Spectra, poles: ComplexArray, slowest: float, *, most: int) -> ComplexArray:
    """Drop the least important poles (pairs,) until ``most`` are left, and relocate these.

    ``slowest`` is as for :func:`relocated`.
    """
    design, output, _ = _reduced(spectra, poles)
    inputs = spectra.inputs.shape[1]
    while len(poles) > most:
        least = int(np.argmin(_grown(design, output, inputs)[1]))
        design = np.delete(design, _columns(least, len(poles), inputs), axis=1)
        poles = np.delete(poles, least)
    for _ in range(3):
        poles = relocated(spectra, poles, slowest)
    return poles


class _Reduced(NamedTuple):
    """A design in the coordinates of its own columns, the output in them, and what is beyond."""

    design: FloatArray
    output: FloatArray
    beyond: float


def _reduced(spectra: Spectra, poles: ComplexArray) -> _Reduced:
    """Return the least-squares problem of some poles as a triangle, factorised once for all."""
    design, output = _design(spectra, poles)
    q, r = np.linalg.qr(design / np.linalg.norm(design, axis=0))
    told = q.T @ output
    return _Reduced(r, told, float(np.sum((output - q @ told) ** 2)))


def _grown(design: FloatArray, output: FloatArray, inputs: int) -> tuple[float, FloatArray]:
    """Return what a design (n, columns) leaves, and by how much it grows (pairs,) without each."""
    q, r = np.linalg.qr(design)
    amounts = np.linalg.solve(r, q.T @ output)
    inverse = np.linalg.inv(r)
    covariance = inverse @ inverse.T
    pairs = design.shape[1] // (2 * inputs)
    grown = np.empty(pairs)
    for k in range(pairs):
        own = _columns(k, pairs, inputs)
        theta = amounts[own]
        grown[k] = theta @ np.linalg.solve(covariance[np.ix_(own, own)], theta)
    return float(np.sum((output - design @ amounts) ** 2)), grown


def _columns(pair: int, pairs: int, inputs: int) -> list[int]:
    """Return the columns of a design that belong to a pair of poles."""
    return [2 * (j * pairs + pair) + part for j in range(inputs) for part in (0, 1)]


def _design(spectra: Spectra, poles: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Return what each pole makes of each input, side by side, and the output."""
    basis = _basis(spectra.z, poles)
    rows = [np.hstack([basis * x[:, None] for x in inputs]) for inputs in spectra.inputs]
    return _parts(np.vstack(rows)), _parts(spectra.output.ravel())


def _basis(z: ComplexArray, poles: ComplexArray) -> ComplexArray:
    """Return two functions of each pair of poles (lines, 2 pairs) with real coefficients."""
    above, below = 1.0 / (z[:, None] - poles), 1.0 / (z[:, None] - poles.conj())
    both = np.stack([above + below, 1j * (above - below)], axis=2)
    return np.asarray(both.reshape(len(z), -1))


def _parts(values: ComplexArray) -> FloatArray:
    """Return the real parts and, below, the imaginary ones."""
    return np.concatenate([values.real, values.imag])


def _tamed(found: ComplexArray, slowest: float) -> ComplexArray:
    """Return stable poles above the real axis; real ones become pairs again."""
    modulus = np.abs(found)
    found = np.where(modulus > 1.0, 1.0 / found.conj(), found)
    modulus = np.abs(found)
    found = np.where(modulus > slowest, found * slowest / np.maximum(modulus, slowest), found)
    above = found[found.imag > _REAL]
    real = np.sort(found[np.abs(found.imag) <= _REAL].real)
    pairs = [complex(real[k : k + 2].mean(), _APART) for k in range(0, len(real) - 1, 2)]
    return np.array(sorted([*above, *pairs], key=np.angle))
