"""Discrete transfer functions: poles, zeros, gain, frequency response, simulation."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray, read_only
from rotemina.sim.identification.errors import SettingError
from rotemina.sim.messages import message


@dataclass(frozen=True, slots=True, eq=False)
class TransferFunction:
    """``H(z) = z^-delay (b0 + b1 z^-1 + …) / (1 + a1 z^-1 + …)`` at a stated sampling rate.

    Attributes
    ----------
    numerator : (nb,) b0, b1, …
    denominator : (na + 1,) 1, a1, …
    delay : samples from input to output; 1 where a held command first shows at the next sample.
    rate_hz : of the samples.

    Raises
    ------
    SettingError
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
                raise SettingError(
                    message("engine", "{name} {values}: must be a row of finite coefficients").fill(
                        name=name, values=str(values)
                    )
                )
            object.__setattr__(self, name, read_only(values))
        if self.denominator[0] != 1.0:
            raise SettingError(
                message("engine", "denominator: must begin with 1, not {denominator}").fill(
                    denominator=self.denominator[0]
                )
            )
        if self.delay < 0:
            raise SettingError(
                message("engine", "delay {delay} samples: cannot be negative").fill(
                    delay=self.delay
                )
            )
        if not (np.isfinite(self.rate_hz) and self.rate_hz > 0):
            raise SettingError(
                message("engine", "rate {rate_hz} Hz: use a positive number").fill(
                    rate_hz=repr(self.rate_hz)
                )
            )

    @property
    def poles(self) -> ComplexArray:
        """Poles in z, (na,); those at 0 of delay and longer numerators are left out."""
        return np.roots(self.denominator).astype(np.complex128)

    @property
    def zeros(self) -> ComplexArray:
        """Zeros in z, (nb − 1,) or fewer where leading coefficients vanish."""
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
        back = np.exp(-2j * np.pi * np.asarray(frequency_hz) / self.rate_hz)
        polynomial = np.polynomial.polynomial.polyval
        above, below = (polynomial(back, c) for c in (self.numerator, self.denominator))
        return np.asarray(back**self.delay * above / below, dtype=np.complex128)

    def simulate(self, input_signal: FloatArray) -> FloatArray:
        """Return the output (n,) from rest at zero for an input (n,)."""
        return filtered(np.r_[np.zeros(self.delay), self.numerator], self.denominator, input_signal)


def is_stable(denominator: FloatArray) -> bool:
    """Whether all roots of ``1 + a1 z^-1 + …`` (na + 1,) lie inside the unit circle."""
    return bool(np.all(np.abs(np.roots(denominator)) < 1.0))


def stabilised(denominator: FloatArray) -> FloatArray:
    """Return a denominator (na + 1,) whose roots outside the unit circle are mirrored inside."""
    roots = np.roots(denominator).astype(np.complex128)
    outside = np.abs(roots) >= 1.0
    if not outside.any():
        return denominator
    roots[outside] = 1.0 / np.conj(roots[outside])
    roots[np.abs(roots) >= 1.0 - 1e-9] *= 1.0 - 1e-6
    mirrored = np.zeros(len(denominator))
    mirrored[: len(roots) + 1] = np.real(np.poly(roots))
    return mirrored


def filtered(numerator: FloatArray, denominator: FloatArray, signal: FloatArray) -> FloatArray:
    """Return ``B(q)/A(q) signal`` (n,) from rest."""
    from scipy.signal import lfilter  # takes its time to import

    return np.asarray(lfilter(numerator, denominator, signal), dtype=np.float64)


def shifted(signal: FloatArray, samples: int) -> FloatArray:
    """Return a signal (n,) later by ``samples`` ≥ 0, zero before."""
    if samples == 0:
        return signal
    later = np.zeros_like(signal)
    later[samples:] = signal[: max(len(signal) - samples, 0)]
    return later
