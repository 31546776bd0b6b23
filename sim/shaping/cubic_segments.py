"""Approximation of a move by a few cubics, which a board can run by itself."""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ShapingError
from rotemina.sim.messages import format_rounded
from rotemina.sim.shaping.move_shape import MoveShape, merge_breaks, sum_coefficients

# Number of instants at which one cubic may end and the next begin.
_CANDIDATE_COUNT = 65
# Points of a cubic, as shares of its duration, at which its error is sampled to choose the breaks.
_SAMPLE_POINTS = np.linspace(0.0, 1.0, 27)[1:-1]


@dataclass(frozen=True, slots=True, eq=False)
class CubicFit:
    """Cubics that approximate a move, with continuous position and speed.

    ``error`` is the largest distance from the move, m or rad. It is exact, because it is evaluated
    at the extremes of the difference.
    """

    shape: MoveShape
    error: float


def fit_cubics(shape: MoveShape, max_pieces: int, max_error: float) -> CubicFit:
    """Approximate a move by at most ``max_pieces`` cubics.

    A move that already consists of at most that many cubics is returned unchanged. Otherwise each
    cubic has the position and speed of the move at its two ends. The ends are chosen among 65
    instants so that the largest error is minimal (dynamic programming).

    Raises
    ------
    ShapingError
        If the error is greater than ``max_error``.
    """
    degree, pieces = shape.coefficients.shape[0] - 1, shape.coefficients.shape[1]
    if degree <= 3 and pieces <= max_pieces:
        return CubicFit(shape, 0.0)
    instants = _make_candidates(shape)
    fit = _interpolate_hermite(
        shape, instants[_choose_breaks(_compute_segment_errors(shape, instants), max_pieces)]
    )
    error = _compute_max_distance(shape, fit)
    if error > max_error:
        raise ShapingError(
            "profile: {most_pieces} cubics leave an error of {error}, more than "
            "{most_error} (SI units); choose a smoother profile, or input shaping of a "
            "lower order",
            most_pieces=max_pieces,
            error=format_rounded(error, 3),
            most_error=format_rounded(max_error, 3),
        )
    return CubicFit(fit, error)


def _make_candidates(shape: MoveShape) -> FloatArray:
    breaks = shape.breaks_s
    if len(breaks) > _CANDIDATE_COUNT:
        breaks = breaks[np.unique(np.linspace(0, len(breaks) - 1, _CANDIDATE_COUNT).astype(int))]
    between = np.linspace(0.0, shape.duration_s, max(_CANDIDATE_COUNT - len(breaks), 2))
    return merge_breaks(breaks, between)


def _compute_segment_errors(shape: MoveShape, instants: FloatArray) -> FloatArray:
    """Return the errors (n, n) of one cubic from one instant to a later one.

    They are infinite where the second instant is not later.
    """
    position, speed = shape.polynomial, shape.polynomial.derivative()
    positions, speeds = np.asarray(position(instants)), np.asarray(speed(instants))
    begins, ends = np.triu_indices(len(instants), 1)
    durations_s = (instants[ends] - instants[begins])[:, None]
    s = _SAMPLE_POINTS[None, :]
    cubic = (
        positions[begins, None] * (1 + 2 * s) * (1 - s) ** 2
        + durations_s * speeds[begins, None] * s * (1 - s) ** 2
        + positions[ends, None] * s**2 * (3 - 2 * s)
        + durations_s * speeds[ends, None] * s**2 * (s - 1)
    )
    errors = np.full((len(instants), len(instants)), np.inf)
    errors[begins, ends] = np.abs(cubic - position(instants[begins, None] + s * durations_s)).max(
        axis=1
    )
    return errors


def _choose_breaks(errors: FloatArray, max_pieces: int) -> list[int]:
    """Return the indices of the instants that make the largest of the segment errors minimal."""
    cost = errors[0]
    predecessors: list[FloatArray] = []
    for _ in range(max_pieces - 1):
        costs = np.maximum(cost[:, None], errors)
        # The first row keeps the solution with fewer pieces.
        costs[0] = errors[0]
        predecessors.append(np.argmin(costs, axis=0))
        cost = costs.min(axis=0)
    index, chosen_indices = len(errors) - 1, [len(errors) - 1]
    for predecessor in reversed(predecessors):
        index = int(predecessor[index])
        if index == 0:
            break
        chosen_indices.append(index)
    return [0, *reversed(chosen_indices)]


def _interpolate_hermite(shape: MoveShape, instants: FloatArray) -> MoveShape:
    polynomial = shape.polynomial
    spline = scipy.interpolate.CubicHermiteSpline(
        instants, polynomial(instants), polynomial.derivative()(instants)
    )
    return MoveShape(spline.x, spline.c)


def _compute_max_distance(first: MoveShape, second: MoveShape) -> float:
    breaks = merge_breaks(first.breaks_s, second.breaks_s)
    difference = sum_coefficients(breaks, first.split_at(breaks), -second.split_at(breaks))
    return difference.max_magnitude(0)
