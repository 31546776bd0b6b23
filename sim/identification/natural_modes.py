"""Natural modes of an identified model: frequency and damping from its poles.

A pole z of samples at rate f_s corresponds to ``s = f_s ln z`` of the machine; a pair of complex
poles is one mode with ``ω0 = |s|`` and ``ζ = −Re s / |s|``. Source: G. F. Franklin, J. D. Powell,
M. Workman, *Digital Control of Dynamic Systems*, 3rd ed., 1998, section 4.3.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.model import IdentifiedModel
from rotemina.sim.identification.transfer_function import TransferFunction

_AT_ZERO = 1e-9  # size of a pole below which it is a delay and no motion of the machine
_REAL = 1e-12  # imaginary part of a pole that rounding alone leaves
BAND_SHARE = 0.8  # of half the sampling rate, above which a mode is not told from a delay


class NaturalMode(NamedTuple):
    """One mode, or one real pole (then ``damping_ratio`` is 1, or −1 if it grows).

    Each ``…_deviation`` is a standard deviation by linear propagation of the model's covariance.
    """

    frequency_hz: float
    damping_ratio: float
    frequency_deviation: float
    damping_deviation: float
    oscillates: bool


def natural_modes(model: IdentifiedModel) -> tuple[NaturalMode, ...]:
    """Return the modes of a fitted model, the one that moves the output most first.

    A pole at zero is a delay and is left out. What moves the output most is judged by the energy
    ``|c|² / (1 − |z|²)`` of each pole's part ``c zⁿ`` of the impulse response.
    """
    transfer = model.transfer_function
    poles = transfer.poles
    chosen = poles[(poles.imag > -_REAL) & (np.abs(poles) > _AT_ZERO)]
    ordered = sorted(chosen, key=lambda pole: -_energy(transfer, pole))
    kept = len(transfer.numerator)
    covariance = model.covariance[kept:, kept:]
    return tuple(_mode(transfer, complex(pole), covariance) for pole in ordered)


def _energy(transfer: TransferFunction, pole: complex) -> float:
    """Return the energy of one pole's part of the impulse response; infinite without decay."""
    if abs(pole) >= 1.0:
        return np.inf
    others = list(transfer.poles)
    others.remove(min(others, key=lambda each: abs(each - pole)))
    below = np.prod([1.0 - other / pole for other in others])
    above = np.polynomial.polynomial.polyval(1.0 / pole, transfer.numerator)
    part = abs(above) / max(abs(below), 1e-300)
    pair = 2.0 if abs(pole.imag) > _REAL else 1.0
    return float(pair * part**2 / (1.0 - abs(pole) ** 2))


def _mode(transfer: TransferFunction, pole: complex, covariance: FloatArray) -> NaturalMode:
    oscillates = abs(pole.imag) > _REAL
    s = transfer.rate_hz * np.log(pole if oscillates else complex(pole.real))
    size = max(abs(s), 1e-300)
    # ∂z/∂a_k = −z^(n−k) / A'(z), by differentiating A(z) = 0.
    order = len(transfer.denominator) - 1
    slope = np.polyval(np.polyder(transfer.denominator), pole)
    moved = -(pole ** np.arange(order - 1, -1, -1)) / (slope if slope else np.nan)
    by_s = transfer.rate_hz / pole * moved
    by_size = (np.conj(s) * by_s).real / size
    by_ratio = -by_s.real / size + s.real / size**2 * by_size
    return NaturalMode(
        float(size / (2.0 * np.pi)),
        float(-s.real / size),
        _spread(by_size, covariance) / (2.0 * np.pi),
        _spread(by_ratio, covariance),
        oscillates,
    )


def _spread(slope: FloatArray, covariance: FloatArray) -> float:
    return float(np.sqrt(max(float(slope @ covariance @ slope), 0.0)))
