"""The shape of a move: position over time as a piecewise polynomial."""

from dataclasses import dataclass
from math import factorial
from typing import Self

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.errors import ShapingError

# Instants closer than this share of the duration are merged.
_MIN_INTERVAL_RATIO = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class MoveShape:
    """A move as pieces ``x(t) = Σ c[d] (t − t₀)^(D−d)``.

    Before the first piece the axis is at 0, and after the last one it is at rest.

    Attributes
    ----------
    breaks_s : (n + 1,)
        Times at which the pieces begin and end, s, rising from 0.
    coefficients : (D + 1, n)
        Coefficients of each piece, highest power first; m or rad.

    Raises
    ------
    ShapingError
        If shapes do not match, a number is not finite, or the times do not rise from 0.
    """

    breaks_s: FloatArray
    coefficients: FloatArray

    def __post_init__(self) -> None:
        for name in ("breaks_s", "coefficients"):
            array = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, make_read_only(array))
        times, values = self.breaks_s, self.coefficients
        if values.ndim != 2 or times.shape != (values.shape[1] + 1,) or len(times) < 2:
            raise ShapingError(
                "shape: {shape} times for coefficients {values_shape}",
                shape=str(times.shape),
                values_shape=str(values.shape),
            )
        if not (np.isfinite(times).all() and np.isfinite(values).all()):
            raise ShapingError("shape: times and coefficients must be finite")
        if times[0] != 0.0 or (np.diff(times) <= 0.0).any():
            raise ShapingError("shape: times must rise from 0 s")

    @classmethod
    def from_polynomial(cls, polynomial: "scipy.interpolate.PPoly") -> Self:
        """Return the shape of a polynomial that begins at 0 s."""
        return cls(polynomial.x, polynomial.c)

    @property
    def polynomial(self) -> "scipy.interpolate.PPoly":
        """The pieces alone, without the rest before and after them."""
        return scipy.interpolate.PPoly(self.coefficients, self.breaks_s)

    @property
    def duration_s(self) -> float:
        """Duration of the move."""
        return float(self.breaks_s[-1])

    @property
    def length(self) -> float:
        """Signed length of the move, m or rad."""
        return float(self._end_values(0)[1, -1])

    @property
    def average_speed(self) -> float:
        """``|length| / duration``, m/s or rad/s."""
        return abs(self.length) / self.duration_s

    def position(self, time_s: FloatArray) -> FloatArray:
        """Return positions at times (…,), m or rad."""
        time_s = np.asarray(time_s, dtype=np.float64)
        positions = self.polynomial(np.clip(time_s, 0.0, self.duration_s))
        positions = np.where(time_s >= self.duration_s, self.length, positions)
        return np.asarray(np.where(time_s <= 0.0, 0.0, positions), dtype=np.float64)

    def extremes(self, order: int = 0) -> tuple[float, float]:
        """Return minimum and maximum of a derivative: 0 position, 1 speed, 2 acceleration.

        They are exact, because the ends of the pieces and the roots of the next derivative are
        evaluated.
        """
        next_derivative = self.polynomial.derivative(order + 1)
        stationary_s = next_derivative.roots(discontinuity=False, extrapolate=False)
        stationary_s = stationary_s[np.isfinite(stationary_s)]
        stationary_values = (
            self.polynomial.derivative(order)(stationary_s)
            if order
            else self.polynomial(stationary_s)
        )
        values = np.concatenate([self._end_values(order).ravel(), np.ravel(stationary_values)])
        return float(values.min()), float(values.max())

    def max_magnitude(self, order: int) -> float:
        """Return the largest magnitude of a derivative: 1 speed, 2 acceleration, 3 jerk."""
        return max(map(abs, self.extremes(order)))

    def max_jump(self, order: int) -> float:
        """Return the largest jump of a derivative.

        The two ends of the move count too; outside it derivatives are 0.
        """
        begins, ends = self._end_values(order)
        inner = begins[1:] - ends[:-1]
        outer = [begins[0], 0.0 if order == 0 else ends[-1]]
        return float(np.abs(np.concatenate([inner, outer])).max())

    def scale(self, factor: float) -> Self:
        """Return the move with ``factor`` times the length and the same duration."""
        return type(self)(self.breaks_s, factor * self.coefficients)

    def split_at(self, breaks_s: FloatArray) -> FloatArray:
        """Return coefficients (D + 1, m) of the pieces between other times (m + 1,).

        No break of the shape may lie inside one of these pieces. They may lie before or after the
        shape.
        """
        begin, end = breaks_s[:-1], breaks_s[1:]
        middle = 0.5 * (begin + end)
        degree = self.coefficients.shape[0] - 1
        piece_indices = np.clip(
            np.searchsorted(self.breaks_s, middle, "right") - 1, 0, self._piece_count - 1
        )
        elapsed_s = begin - self.breaks_s[piece_indices]
        coefficients = np.zeros((degree + 1, len(begin)))
        derivative = self.coefficients[:, piece_indices]
        for order in range(degree + 1):
            coefficients[degree - order] = _evaluate_polynomials(derivative, elapsed_s) / factorial(
                order
            )
            powers = np.arange(len(derivative) - 1, 0, -1)[:, None]
            derivative = (
                derivative[:-1] * powers if len(derivative) > 1 else np.zeros((1, len(begin)))
            )
        coefficients[:, (middle < 0.0) | (middle > self.duration_s)] = 0.0
        coefficients[-1, middle > self.duration_s] = self.length
        return coefficients

    @property
    def _piece_count(self) -> int:
        return len(self.breaks_s) - 1

    def _end_values(self, order: int) -> FloatArray:
        """Return a derivative (2, n) at the beginning and at the end of each piece."""
        derivative = self.polynomial.derivative(order).c if order else self.coefficients
        spans = np.diff(self.breaks_s)
        return np.array([derivative[-1], _evaluate_polynomials(derivative, spans)])


def merge_breaks(*arrays: FloatArray) -> FloatArray:
    """Return the times of several arrays in rising order, with equal ones merged."""
    times = np.unique(np.concatenate(arrays))
    is_distinct = np.diff(times) > _MIN_INTERVAL_RATIO * (times[-1] - times[0])
    return np.asarray(times[np.concatenate([[True], is_distinct])])


def sum_coefficients(breaks_s: FloatArray, *parts: FloatArray) -> MoveShape:
    """Return the sum of moves with coefficients (Dᵢ + 1, n) on the same pieces."""
    rows = max(len(part) for part in parts)
    total = np.zeros((rows, len(breaks_s) - 1))
    for part in parts:
        total[rows - len(part) :] += part
    return MoveShape(breaks_s, total)


def _evaluate_polynomials(coefficients: FloatArray, points: FloatArray) -> FloatArray:
    """Return the values (n,) of polynomials (D + 1, n), each at its own point (n,)."""
    value = np.zeros_like(points)
    for row in coefficients:
        value = value * points + row
    return np.asarray(value)
