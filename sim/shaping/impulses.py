"""Input shaping: a move is the sum of delayed copies whose vibrations cancel.

Source: Singer and Seering, J. Dyn. Sys., Meas., Control 112 (1990) 76–82.
"""

from dataclasses import dataclass
from math import exp, isfinite, pi, sqrt

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.errors import ShapingError
from rotemina.sim.shaping.move_shape import MoveShape, merge_breaks, sum_coefficients

MAX_SHAPER_ORDER = 4


@dataclass(frozen=True, slots=True, eq=False)
class InputShaper:
    """Impulses that a move is convolved with.

    Attributes
    ----------
    times_s : (n,)
        Times of the impulses, rising from 0.
    amplitudes : (n,)
        Positive amplitudes. Their sum is 1, so that the length of the move stays the same.
    """

    times_s: FloatArray
    amplitudes: FloatArray

    def __post_init__(self) -> None:
        for name in ("times_s", "amplitudes"):
            array = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, make_read_only(array))

    @property
    def duration_s(self) -> float:
        """Time by which a move becomes longer."""
        return float(self.times_s[-1])

    def combine_with(self, other: "InputShaper") -> "InputShaper":
        """Return the convolution of both shapers.

        It suppresses two resonances, or one resonance whose frequency varies.
        """
        times = np.add.outer(self.times_s, other.times_s).ravel()
        amplitudes = np.multiply.outer(self.amplitudes, other.amplitudes).ravel()
        order = np.argsort(times, kind="stable")
        times, amplitudes = times[order], amplitudes[order]
        # Impulses at equal times up to rounding are merged.
        is_first = np.concatenate([[True], np.diff(times) > 1e-9 * (times[-1] or 1.0)])
        return InputShaper(times[is_first], np.add.reduceat(amplitudes, np.flatnonzero(is_first)))

    def residual_vibration(self, frequency_hz: FloatArray, damping_ratio: float) -> FloatArray:
        """Return the residual vibration (…,) at some frequencies, relative to a single impulse.

        ``V = e^(−ζω t_n) |Σ A_i e^(ζω t_i) e^(i ω_d t_i)|``, where t_n is the time of the last
        impulse.
        """
        omega = 2.0 * pi * np.asarray(frequency_hz, dtype=np.float64)[..., None]
        pole = omega * (damping_ratio + 1j * sqrt(1.0 - damping_ratio**2))
        terms = self.amplitudes * np.exp(pole * self.times_s)
        decay = np.exp(-damping_ratio * omega[..., 0] * self.duration_s)
        return np.asarray(decay * np.abs(terms.sum(axis=-1)))


def make_zero_vibration_shaper(
    frequency_hz: float, damping_ratio: float, order: int = 1
) -> InputShaper:
    """Return the shaper that leaves no vibration of this frequency.

    Order 1 is ZV: two impulses with amplitudes ``1 : K``, ``K = e^(−πζ/√(1−ζ²))``, half a damped
    period apart. Order 2 is ZVD, whose residual vibration also has zero slope with respect to the
    frequency. Order 3 is ZVDD, and so on. Each order convolves once more with ZV and takes half a
    period longer.

    Raises
    ------
    ShapingError
        If the frequency is not positive, or damping ratio or order is out of range.
    """
    if not isfinite(frequency_hz) or frequency_hz <= 0.0 or not 0.0 <= damping_ratio < 1.0:
        raise ShapingError(
            "input shaping for {frequency_hz} Hz and a damping ratio of {damping_ratio}: the "
            "frequency must be positive, the ratio at least 0 and less than 1",
            frequency_hz=frequency_hz,
            damping_ratio=damping_ratio,
        )
    if not 1 <= order <= MAX_SHAPER_ORDER:
        raise ShapingError(
            "input shaping of order {order}: must be 1 (ZV) to {most_order}",
            order=order,
            most_order=MAX_SHAPER_ORDER,
        )
    damping_root = sqrt(1.0 - damping_ratio**2)
    decay = exp(-pi * damping_ratio / damping_root)
    half_s = 0.5 / (frequency_hz * damping_root)
    zv_amplitudes = np.array([1.0, decay]) / (1.0 + decay)
    amplitudes = zv_amplitudes
    for _ in range(order - 1):
        amplitudes = np.convolve(amplitudes, zv_amplitudes)
    return InputShaper(half_s * np.arange(order + 1.0), amplitudes)


def apply_shaper(shape: MoveShape, shaper: InputShaper) -> MoveShape:
    """Return the shaped move ``Σ A_i x(t − t_i)``.

    Its length is the same, and it takes longer by the duration of the shaper.
    """
    breaks = merge_breaks(*(shape.breaks_s + delay for delay in shaper.times_s))
    parts = [
        amplitude * shape.split_at(breaks - delay)
        for delay, amplitude in zip(shaper.times_s, shaper.amplitudes, strict=True)
    ]
    return sum_coefficients(breaks, *parts)
