"""A move as a few cubics, which is what a board runs by itself."""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.shaping.errors import ShapingError
from rotemina.sim.shaping.move_shape import Shape, joined_breaks, summed

_CANDIDATES = 65  # places at which one cubic may end and the next begin
_LOOKS = np.linspace(0.0, 1.0, 27)[1:-1]  # places of a cubic at which the choice looks


@dataclass(frozen=True, slots=True, eq=False)
class CubicFit:
    """Cubics with neither jumps of position nor of speed, and how far they are from the move.

    ``error`` is the greatest distance, m or rad, exact: found at the turns of the difference.
    """

    shape: Shape
    error: float


def as_cubics(shape: Shape, most_pieces: int, most_error: float) -> CubicFit:
    """Return a move in at most so many cubics: itself, where it is such a move already.

    Otherwise each cubic has the move's position and speed at its two ends, which are chosen among
    65 places so that the greatest error is least (dynamic programming).

    Raises
    ------
    ShapingError
        If the error is greater than ``most_error``.
    """
    degree, pieces = shape.coefficients.shape[0] - 1, shape.coefficients.shape[1]
    if degree <= 3 and pieces <= most_pieces:
        return CubicFit(shape, 0.0)
    places = _candidates(shape)
    fit = _hermite(shape, places[_chosen(_errors(shape, places), most_pieces)])
    error = _distance(shape, fit)
    if error > most_error:
        raise ShapingError(
            message(
                "engine",
                "profile: {most_pieces} cubics leave an error of {error}, more than "
                "{most_error} (SI units); choose a smoother profile, or input shaping of a "
                "lower order",
            ).fill(
                most_pieces=most_pieces, error=rounded(error, 3), most_error=rounded(most_error, 3)
            )
        )
    return CubicFit(fit, error)


def _candidates(shape: Shape) -> FloatArray:
    """Return instants, rising: breaks of the shape, and some between them."""
    breaks = shape.breaks_s
    if len(breaks) > _CANDIDATES:
        breaks = breaks[np.unique(np.linspace(0, len(breaks) - 1, _CANDIDATES).astype(int))]
    between = np.linspace(0.0, shape.duration_s, max(_CANDIDATES - len(breaks), 2))
    return joined_breaks(breaks, between)


def _errors(shape: Shape, places: FloatArray) -> FloatArray:
    """Return the error (n, n) of one cubic from a place to a later one; infinite elsewhere."""
    position, speed = shape.polynomial, shape.polynomial.derivative()
    x, v = np.asarray(position(places)), np.asarray(speed(places))
    low, high = np.triu_indices(len(places), 1)
    span = (places[high] - places[low])[:, None]
    s = _LOOKS[None, :]
    cubic = (
        x[low, None] * (1 + 2 * s) * (1 - s) ** 2
        + span * v[low, None] * s * (1 - s) ** 2
        + x[high, None] * s**2 * (3 - 2 * s)
        + span * v[high, None] * s**2 * (s - 1)
    )
    error = np.full((len(places), len(places)), np.inf)
    error[low, high] = np.abs(cubic - position(places[low, None] + s * span)).max(axis=1)
    return error


def _chosen(error: FloatArray, most_pieces: int) -> list[int]:
    """Return the places (numbers, rising) between which the greatest error is least."""
    cost = error[0]
    before: list[FloatArray] = []
    for _ in range(most_pieces - 1):
        through = np.maximum(cost[:, None], error)
        through[0] = error[0]  # or fewer pieces
        before.append(np.argmin(through, axis=0))
        cost = through.min(axis=0)
    at, chosen = len(error) - 1, [len(error) - 1]
    for last in reversed(before):
        at = int(last[at])
        if at == 0:
            break
        chosen.append(at)
    return [0, *reversed(chosen)]


def _hermite(shape: Shape, places: FloatArray) -> Shape:
    """Return the cubics through a move's positions and speeds at some instants."""
    polynomial = shape.polynomial
    spline = scipy.interpolate.CubicHermiteSpline(
        places, polynomial(places), polynomial.derivative()(places)
    )
    return Shape(spline.x, spline.c)


def _distance(one: Shape, other: Shape) -> float:
    breaks = joined_breaks(one.breaks_s, other.breaks_s)
    difference = summed(breaks, one.refined(breaks), -other.refined(breaks))
    return difference.greatest(0)
