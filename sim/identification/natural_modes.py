"""Natural modes of an identified model: frequency and damping from its poles.

A pole z of a model sampled at rate f_s corresponds to the pole ``s = f_s ln z`` of the machine. A
pair of complex poles is one mode with ``ω0 = |s|`` and ``ζ = −Re s / |s|``. Source: G. F. Franklin,
J. D. Powell, M. Workman, *Digital Control of Dynamic Systems*, 3rd ed., 1998, section 4.3.
"""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.model import IdentifiedModel
from rotemina.sim.identification.transfer_function import TransferFunction

# A pole with a smaller modulus is a delay, not a motion of the machine.
_MIN_POLE_MODULUS = 1e-9
# A pole counts as real if its imaginary part is at most this; rounding causes such parts.
_MAX_REAL_POLE_IMAGINARY = 1e-12
# Largest frequency, as a share of half the sampling rate, at which a mode can be distinguished from
# a delay.
MAX_MODE_NYQUIST_RATIO = 0.8


class NaturalMode(NamedTuple):
    """A natural mode. ``damping_ratio`` is 1 for a stable real pole, −1 for an unstable one.

    Each ``…_deviation`` is a standard deviation by linear propagation of the model's covariance.
    """

    frequency_hz: float
    damping_ratio: float
    frequency_deviation: float
    damping_deviation: float
    oscillates: bool


def find_natural_modes(model: IdentifiedModel) -> tuple[NaturalMode, ...]:
    """Return the modes of a fitted model, beginning with the one that moves the output most.

    A pole at zero is a delay and is left out. The order follows from the energy
    ``|c|² / (1 − |z|²)`` of each pole's part ``c zⁿ`` of the impulse response.
    """
    transfer = model.transfer_function
    poles = transfer.poles
    selected_poles = poles[
        (poles.imag > -_MAX_REAL_POLE_IMAGINARY) & (np.abs(poles) > _MIN_POLE_MODULUS)
    ]
    ordered_poles = sorted(selected_poles, key=lambda pole: -_compute_energy(transfer, pole))
    numerator_length = len(transfer.numerator)
    covariance = model.covariance[numerator_length:, numerator_length:]
    return tuple(_make_mode(transfer, complex(pole), covariance) for pole in ordered_poles)


def _compute_energy(transfer: TransferFunction, pole: complex) -> float:
    """Return the energy of one pole's part of the impulse response; infinite if undamped."""
    if abs(pole) >= 1.0:
        return np.inf
    others = list(transfer.poles)
    others.remove(min(others, key=lambda candidate: abs(candidate - pole)))
    denominator = np.prod([1.0 - other / pole for other in others])
    numerator = np.polynomial.polynomial.polyval(1.0 / pole, transfer.numerator)
    residue = abs(numerator) / max(abs(denominator), 1e-300)
    pole_count = 2.0 if abs(pole.imag) > _MAX_REAL_POLE_IMAGINARY else 1.0
    return float(pole_count * residue**2 / (1.0 - abs(pole) ** 2))


def _make_mode(transfer: TransferFunction, pole: complex, covariance: FloatArray) -> NaturalMode:
    oscillates = abs(pole.imag) > _MAX_REAL_POLE_IMAGINARY
    s = transfer.rate_hz * np.log(pole if oscillates else complex(pole.real))
    natural_frequency = max(abs(s), 1e-300)
    # ∂z/∂a_k = −z^(n−k) / A'(z), by differentiating A(z) = 0.
    order = len(transfer.denominator) - 1
    polynomial_slope = np.polyval(np.polyder(transfer.denominator), pole)
    pole_gradient = -(pole ** np.arange(order - 1, -1, -1)) / (
        polynomial_slope if polynomial_slope else np.nan
    )
    s_gradient = transfer.rate_hz / pole * pole_gradient
    frequency_gradient = (np.conj(s) * s_gradient).real / natural_frequency
    damping_gradient = (
        -s_gradient.real / natural_frequency + s.real / natural_frequency**2 * frequency_gradient
    )
    return NaturalMode(
        float(natural_frequency / (2.0 * np.pi)),
        float(-s.real / natural_frequency),
        _propagate_deviation(frequency_gradient, covariance) / (2.0 * np.pi),
        _propagate_deviation(damping_gradient, covariance),
        oscillates,
    )


def _propagate_deviation(gradient: FloatArray, covariance: FloatArray) -> float:
    return float(np.sqrt(max(float(gradient @ covariance @ gradient), 0.0)))
