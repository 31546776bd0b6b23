"""Input shaping: a move is made several times, a little later each, so that its vibration cancels.

Source: Singer and Seering, J. Dyn. Sys., Meas., Control 112 (1990) 76–82.
"""

from dataclasses import dataclass
from math import exp, isfinite, pi, sqrt

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.messages import message
from rotemina.sim.shaping.errors import ShapingError
from rotemina.sim.shaping.move_shape import Shape, joined_breaks, summed

MOST_ORDER = 4


@dataclass(frozen=True, slots=True, eq=False)
class Shaper:
    """Impulses that a move is convolved with.

    Attributes
    ----------
    times_s : (n,)
        Rising from 0.
    amplitudes : (n,)
        Positive, their sum is 1: the move goes as far as before.
    """

    times_s: FloatArray
    amplitudes: FloatArray

    def __post_init__(self) -> None:
        for name in ("times_s", "amplitudes"):
            array = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, read_only(array))

    @property
    def duration_s(self) -> float:
        """By how much a move gets longer."""
        return float(self.times_s[-1])

    def before(self, other: "Shaper") -> "Shaper":
        """Return both, one after the other: for a machine of two resonances, or one that drifts."""
        times = np.add.outer(self.times_s, other.times_s).ravel()
        amplitudes = np.multiply.outer(self.amplitudes, other.amplitudes).ravel()
        order = np.argsort(times, kind="stable")
        times, amplitudes = times[order], amplitudes[order]
        # Impulses that fall together up to rounding are one.
        first = np.concatenate([[True], np.diff(times) > 1e-9 * (times[-1] or 1.0)])
        return Shaper(times[first], np.add.reduceat(amplitudes, np.flatnonzero(first)))

    def residual(self, frequency_hz: FloatArray, damping_ratio: float) -> FloatArray:
        """Return the vibration (…,) left at some frequencies, as a share of that of one impulse.

        ``V = e^(−ζω t_n) |Σ A_i e^(ζω t_i) e^(i ω_d t_i)|``, in which t_n is the last impulse.
        """
        rate = 2.0 * pi * np.asarray(frequency_hz, dtype=np.float64)[..., None]
        pole = rate * (damping_ratio + 1j * sqrt(1.0 - damping_ratio**2))
        terms = self.amplitudes * np.exp(pole * self.times_s)
        left = np.exp(-damping_ratio * rate[..., 0] * self.duration_s)
        return np.asarray(left * np.abs(terms.sum(axis=-1)))


def zero_vibration(frequency_hz: float, damping_ratio: float, order: int = 1) -> Shaper:
    """Return the shaper that leaves no vibration of this frequency.

    Order 1 is ZV: two impulses, half a damped period apart, of ``1 : K`` with
    ``K = e^(−πζ/√(1−ζ²))``. Order 2 is ZVD, whose residual has no slope over the frequency either;
    order 3 is ZVDD, and so on: ZV convolved with itself, half a period longer each.

    Raises
    ------
    ShapingError
        If the frequency is not positive, the damping ratio none of 0 to 1, or there is no such
        order.
    """
    if not isfinite(frequency_hz) or frequency_hz <= 0.0 or not 0.0 <= damping_ratio < 1.0:
        raise ShapingError(
            message(
                "engine",
                "input shaping for {frequency_hz} Hz and a damping ratio of {damping_ratio}: the "
                "frequency must be positive, the ratio at least 0 and less than 1",
            ).fill(frequency_hz=frequency_hz, damping_ratio=damping_ratio)
        )
    if not 1 <= order <= MOST_ORDER:
        raise ShapingError(
            message(
                "engine", "input shaping of order {order}: must be 1 (ZV) to {most_order}"
            ).fill(order=order, most_order=MOST_ORDER)
        )
    root = sqrt(1.0 - damping_ratio**2)
    decay = exp(-pi * damping_ratio / root)
    half_s = 0.5 / (frequency_hz * root)
    single = np.array([1.0, decay]) / (1.0 + decay)
    amplitudes = single
    for _ in range(order - 1):
        amplitudes = np.convolve(amplitudes, single)
    return Shaper(half_s * np.arange(order + 1.0), amplitudes)


def shaped(shape: Shape, shaper: Shaper) -> Shape:
    """Return ``Σ A_i x(t − t_i)``: as far as before, longer by the shaper's duration."""
    breaks = joined_breaks(*(shape.breaks_s + at for at in shaper.times_s))
    parts = [
        amplitude * shape.refined(breaks - at)
        for at, amplitude in zip(shaper.times_s, shaper.amplitudes, strict=True)
    ]
    return summed(breaks, *parts)
