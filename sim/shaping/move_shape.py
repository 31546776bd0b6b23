"""The shape of a move: a position over time, as polynomials one after the other."""

from dataclasses import dataclass
from math import factorial
from typing import Self

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.messages import message
from rotemina.sim.shaping.errors import ShapingError

_SAME = 1e-9  # of the duration: instants that are this near are one


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Pieces ``x(t) = Σ c[d] (t − t₀)^(D−d)``; before them the axis is at 0, behind them at rest.

    Attributes
    ----------
    breaks_s : (n + 1,)
        Where the pieces begin and end, s, increasing from 0.
    coefficients : (D + 1, n)
        Of each piece, highest power first; m or rad.

    Raises
    ------
    ShapingError
        If they are no such thing.
    """

    breaks_s: FloatArray
    coefficients: FloatArray

    def __post_init__(self) -> None:
        for name in ("breaks_s", "coefficients"):
            array = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, read_only(array))
        times, values = self.breaks_s, self.coefficients
        if values.ndim != 2 or times.shape != (values.shape[1] + 1,) or len(times) < 2:
            raise ShapingError(
                message("engine", "shape: {shape} times for coefficients {values_shape}").fill(
                    shape=str(times.shape), values_shape=str(values.shape)
                )
            )
        if not (np.isfinite(times).all() and np.isfinite(values).all()):
            raise ShapingError(message("engine", "shape: times and coefficients must be finite"))
        if times[0] != 0.0 or (np.diff(times) <= 0.0).any():
            raise ShapingError(message("engine", "shape: times must rise from 0 s"))

    @classmethod
    def of(cls, polynomial: "scipy.interpolate.PPoly") -> Self:
        """Return the shape of a polynomial that begins at 0 s."""
        return cls(polynomial.x, polynomial.c)

    @property
    def polynomial(self) -> "scipy.interpolate.PPoly":
        """The pieces alone, without what is before and behind them."""
        return scipy.interpolate.PPoly(self.coefficients, self.breaks_s)

    @property
    def duration_s(self) -> float:
        """How long the move takes."""
        return float(self.breaks_s[-1])

    @property
    def length(self) -> float:
        """How far it goes, m or rad; with its sign."""
        return float(self._ends(0)[1, -1])

    @property
    def average_speed(self) -> float:
        """``|length| / duration``, m/s or rad/s."""
        return abs(self.length) / self.duration_s

    def position(self, time_s: FloatArray) -> FloatArray:
        """Return positions at times (…,), m or rad."""
        time_s = np.asarray(time_s, dtype=np.float64)
        inside = self.polynomial(np.clip(time_s, 0.0, self.duration_s))
        inside = np.where(time_s >= self.duration_s, self.length, inside)
        return np.asarray(np.where(time_s <= 0.0, 0.0, inside), dtype=np.float64)

    def extremes(self, order: int = 0) -> tuple[float, float]:
        """Return least and greatest value of a derivative: 0 position, 1 speed, 2 acceleration.

        They are exact: found at the ends of pieces and the roots of the next derivative.
        """
        slope = self.polynomial.derivative(order + 1)
        turns = slope.roots(discontinuity=False, extrapolate=False)
        turns = turns[np.isfinite(turns)]
        inside = self.polynomial.derivative(order)(turns) if order else self.polynomial(turns)
        values = np.concatenate([self._ends(order).ravel(), np.ravel(inside)])
        return float(values.min()), float(values.max())

    def greatest(self, order: int) -> float:
        """Return the greatest amount of a derivative: 1 speed, 2 acceleration, 3 jerk."""
        return max(map(abs, self.extremes(order)))

    def jump(self, order: int) -> float:
        """Return the greatest jump of a derivative, at the two ends too, where it comes from 0."""
        begins, ends = self._ends(order)
        inner = begins[1:] - ends[:-1]
        outer = [begins[0], 0.0 if order == 0 else ends[-1]]
        return float(np.abs(np.concatenate([inner, outer])).max())

    def scaled(self, factor: float) -> Self:
        """Return the move ``factor`` times as far, in the same time."""
        return type(self)(self.breaks_s, factor * self.coefficients)

    def refined(self, breaks_s: FloatArray) -> FloatArray:
        """Return coefficients (D + 1, m) of the pieces between other times (m + 1,).

        No break of the shape may lie within one of them. They may be before or behind the shape.
        """
        begin, end = breaks_s[:-1], breaks_s[1:]
        middle = 0.5 * (begin + end)
        degree = self.coefficients.shape[0] - 1
        piece = np.clip(np.searchsorted(self.breaks_s, middle, "right") - 1, 0, self._pieces - 1)
        since = begin - self.breaks_s[piece]
        found = np.zeros((degree + 1, len(begin)))
        derived = self.coefficients[:, piece]
        for order in range(degree + 1):
            found[degree - order] = _horner(derived, since) / factorial(order)
            powers = np.arange(len(derived) - 1, 0, -1)[:, None]
            derived = derived[:-1] * powers if len(derived) > 1 else np.zeros((1, len(begin)))
        found[:, (middle < 0.0) | (middle > self.duration_s)] = 0.0
        found[-1, middle > self.duration_s] = self.length
        return found

    @property
    def _pieces(self) -> int:
        return len(self.breaks_s) - 1

    def _ends(self, order: int) -> FloatArray:
        """Return a derivative (2, n) at the beginning and the end of each piece, from within."""
        derived = self.polynomial.derivative(order).c if order else self.coefficients
        spans = np.diff(self.breaks_s)
        return np.array([derived[-1], _horner(derived, spans)])


def joined_breaks(*several: FloatArray) -> FloatArray:
    """Return all times of several arrays, rising; those that rounding alone parts are one."""
    times = np.unique(np.concatenate(several))
    apart = np.diff(times) > _SAME * (times[-1] - times[0])
    return np.asarray(times[np.concatenate([[True], apart])])


def summed(breaks_s: FloatArray, *parts: FloatArray) -> Shape:
    """Return the sum of coefficients (Dᵢ + 1, n) on the same pieces."""
    rows = max(len(part) for part in parts)
    total = np.zeros((rows, len(breaks_s) - 1))
    for part in parts:
        total[rows - len(part) :] += part
    return Shape(breaks_s, total)


def _horner(coefficients: FloatArray, at: FloatArray) -> FloatArray:
    """Return the values (n,) of polynomials (D + 1, n), each at its own place (n,)."""
    value = np.zeros_like(at)
    for row in coefficients:
        value = value * at + row
    return np.asarray(value)
