"""Discrete transfer functions: poles, zeros, gain, frequency response, simulation."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import (
    ComplexArray,
    FloatArray,
    make_read_only,
)
from rotemina.sim.errors import IdentificationSettingError


@dataclass(frozen=True, slots=True, eq=False)
class TransferFunction:
    """``H(z) = z^-delay (b0 + b1 z^-1 + …) / (1 + a1 z^-1 + …)`` at a stated sampling rate.

    Attributes
    ----------
    numerator : (nb,)
        b0, b1, …
    denominator : (na + 1,)
        1, a1, …
    delay : int
        Samples from input to output; 1 if a held command first has an effect at the next sample.
    rate_hz : float
        Sampling rate, Hz.

    Raises
    ------
    IdentificationSettingError
        If a coefficient is not finite, the denominator does not begin with 1, or delay or rate
        is out of range.
    """

    numerator: FloatArray
    denominator: FloatArray
    delay: int
    rate_hz: float

    def __post_init__(self) -> None:
        for name in ("numerator", "denominator"):
            values = np.array(getattr(self, name), dtype=np.float64)
            if values.ndim != 1 or not len(values) or not np.isfinite(values).all():
                raise IdentificationSettingError(
                    "{name} {values}: must be a row of finite coefficients",
                    name=name,
                    values=str(values),
                )
            object.__setattr__(self, name, make_read_only(values))
        if self.denominator[0] != 1.0:
            raise IdentificationSettingError(
                "denominator: must begin with 1, not {denominator}", denominator=self.denominator[0]
            )
        if self.delay < 0:
            raise IdentificationSettingError(
                "delay {delay} samples: cannot be negative", delay=self.delay
            )
        if not (np.isfinite(self.rate_hz) and self.rate_hz > 0):
            raise IdentificationSettingError(
                "rate {rate_hz} Hz: use a positive number", rate_hz=repr(self.rate_hz)
            )

    @property
    def poles(self) -> ComplexArray:
        """Poles in z, (na,), without those at 0 that the delay and a long numerator cause."""
        return np.roots(self.denominator).astype(np.complex128)

    @property
    def zeros(self) -> ComplexArray:
        """Zeros in z, (nb − 1,), or fewer if leading coefficients vanish."""
        return np.roots(self.numerator).astype(np.complex128)

    @property
    def stable(self) -> bool:
        """Whether all poles lie inside the unit circle."""
        return is_stable(self.denominator)

    @property
    def static_gain(self) -> float:
        """``H(1)``; infinite (signed as the numerator) or NaN with a pole at exactly 1."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return float(np.sum(self.numerator) / np.sum(self.denominator))

    def response(self, frequency_hz: FloatArray) -> ComplexArray:
        """Return ``H(e^{jωT})`` (k,) at frequencies (k,) in Hz."""
        z_inverse = np.exp(-2j * np.pi * np.asarray(frequency_hz) / self.rate_hz)
        polynomial = np.polynomial.polynomial.polyval
        numerator, denominator = (
            polynomial(z_inverse, coefficients)
            for coefficients in (self.numerator, self.denominator)
        )
        return np.asarray(z_inverse**self.delay * numerator / denominator, dtype=np.complex128)

    def simulate(self, input_signal: FloatArray) -> FloatArray:
        """Return the output (n,) from rest at zero for an input (n,)."""
        return apply_filter(
            np.r_[np.zeros(self.delay), self.numerator], self.denominator, input_signal
        )


def is_stable(denominator: FloatArray) -> bool:
    """Return whether all roots of ``1 + a1 z^-1 + …`` (na + 1,) lie inside the unit circle."""
    return bool(np.all(np.abs(np.roots(denominator)) < 1.0))


def stabilise(denominator: FloatArray) -> FloatArray:
    """Return the denominator (na + 1,) with roots outside the unit circle mirrored inside."""
    roots = np.roots(denominator).astype(np.complex128)
    is_outside = np.abs(roots) >= 1.0
    if not is_outside.any():
        return denominator
    roots[is_outside] = 1.0 / np.conj(roots[is_outside])
    # Mirroring leaves roots on the unit circle where they are, so they are moved slightly inside.
    roots[np.abs(roots) >= 1.0 - 1e-9] *= 1.0 - 1e-6
    mirrored = np.zeros(len(denominator))
    mirrored[: len(roots) + 1] = np.real(np.poly(roots))
    return mirrored


def apply_filter(numerator: FloatArray, denominator: FloatArray, signal: FloatArray) -> FloatArray:
    """Return ``B(q)/A(q) signal`` (n,), starting from rest."""
    # Imported here because the import is slow.
    from scipy.signal import lfilter

    return np.asarray(lfilter(numerator, denominator, signal), dtype=np.float64)


def delay_signal(signal: FloatArray, samples: int) -> FloatArray:
    """Return a signal (n,) delayed by ``samples`` ≥ 0, with zeros before it."""
    if samples == 0:
        return signal
    delayed = np.zeros_like(signal)
    delayed[samples:] = signal[: max(len(signal) - samples, 0)]
    return delayed
