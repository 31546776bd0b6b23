"""The workspace of the tip and the margin to its border.

The position of the tip is that of the pivot, anywhere in the box of the tables, plus the vector of
the pin. The coordinates of this vector

    L sin thy cos thx,   −L sin thx,   L cos thx cos thy

are products of factors that vary independently, so interval products bound them exactly.
"""

from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.aiming import aim_pin
from rotemina.sim.kinematics.chain import NANO, TABLES, KinematicChain
from rotemina.sim.kinematics.forward import compute_tip_from_pivot


class PositionBox(NamedTuple):
    """A box of positions with the corners ``low`` and ``high`` (..., 3), m."""

    low: FloatArray
    high: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class TipWorkspace:
    """The workspace of the tip of a chain. Make an instance by :meth:`of`.

    Attributes
    ----------
    chain : KinematicChain
    pin : PositionBox
        The smallest box that contains all vectors from pivot to tip.
    """

    chain: KinematicChain
    pin: PositionBox

    @classmethod
    def of(cls, chain: KinematicChain) -> Self:
        """Compute the workspace of ``chain``."""
        length, (sin_x, cos_x), (sin_y, cos_y) = _compute_factor_intervals(chain)
        intervals = np.array(
            [
                _multiply_intervals(length, _multiply_intervals(sin_y, cos_x)),
                _multiply_intervals(length, (-sin_x[1], -sin_x[0])),
                _multiply_intervals(length, _multiply_intervals(cos_x, cos_y)),
            ]
        )
        return cls(chain, PositionBox(intervals[:, 0], intervals[:, 1]))

    @property
    def hull(self) -> PositionBox:
        """The smallest box that contains all reachable tip positions."""
        chain = self.chain
        return PositionBox(chain.lower[TABLES] + self.pin.low, chain.upper[TABLES] + self.pin.high)

    @property
    def core(self) -> PositionBox:
        """The box of tip positions that are reachable with any pose of the nano joints."""
        chain = self.chain
        return PositionBox(chain.lower[TABLES] + self.pin.high, chain.upper[TABLES] + self.pin.low)

    @property
    def max_margin_error(self) -> float:
        """Largest amount, m, by which :meth:`margin_at` may be too small.

        It comes from the curvature of the surface that the nano stage reaches.
        """
        length, (sin_x, cos_x), (sin_y, cos_y) = _compute_factor_intervals(self.chain)
        longest, shortest = -length[0], -length[1]
        tilt_x, tilt_y = (max(abs(sine[0]), abs(sine[1])) for sine in (sin_x, sin_y))
        return max(
            tilt_y * (longest - shortest * cos_x[0]),
            tilt_x * (longest - shortest),
            longest * (1.0 - cos_x[0] * cos_y[0]),
        )

    def margin_at(self, tip: FloatArray) -> FloatArray:
        """Return the distance (...), m, of the tip (..., 3) from the border; negative outside.

        The nano pose is chosen so that the tables stay as close to mid-range as possible. The
        margin is then the smallest distance of a table from its end. A reachable tip can make any
        step whose x, y and z are each within the margin. The margin is never too large, and at most
        :attr:`max_margin_error` too small.
        """
        chain = self.chain
        offset = np.asarray(tip, dtype=np.float64) - chain.centre[TABLES]
        bounds = (np.broadcast_to(b[NANO], offset.shape) for b in (chain.lower, chain.upper))
        table_offset = offset - compute_tip_from_pivot(chain, aim_pin(chain, offset, *bounds).pose)
        half_range = 0.5 * (chain.upper - chain.lower)[TABLES]
        return np.asarray((half_range - np.abs(table_offset)).min(axis=-1))


_Interval = tuple[float, float]
_Intervals = tuple[_Interval, _Interval]


def _compute_factor_intervals(chain: KinematicChain) -> tuple[_Interval, _Intervals, _Intervals]:
    """Return the intervals of L, m, and of sine and cosine of thx and of thy."""
    length = float(chain.lower[5]) - chain.pin_length, float(chain.upper[5]) - chain.pin_length
    return (
        length,
        _compute_sine_cosine_intervals(chain, 3),
        _compute_sine_cosine_intervals(chain, 4),
    )


def _compute_sine_cosine_intervals(chain: KinematicChain, joint: int) -> _Intervals:
    """Return the intervals of sine and cosine of one tilt, whose range lies within ±90 degrees."""
    low, high = float(chain.lower[joint]), float(chain.upper[joint])
    cosines = float(np.cos(low)), float(np.cos(high))
    max_cosine = 1.0 if low <= 0.0 <= high else max(cosines)
    return (float(np.sin(low)), float(np.sin(high))), (min(cosines), max_cosine)


def _multiply_intervals(first: _Interval, second: _Interval) -> _Interval:
    products = [a * b for a in first for b in second]
    return min(products), max(products)
