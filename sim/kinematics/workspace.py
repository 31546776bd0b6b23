"""Where the tip can be: with both stages, with the nano stage alone, and by which margin.

The tip is the pivot, anywhere in the tables' box, plus the pin's vector. The vector's coordinates

    L sin thy cos thx,   −L sin thx,   L cos thx cos thy

are products of factors that vary independently, so interval products bound them exactly.
"""

from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.aiming import aim
from rotemina.sim.kinematics.chain import NANO, TABLES, Chain
from rotemina.sim.kinematics.forward import tip_from_pivot


class Box(NamedTuple):
    """Corners ``low`` and ``high`` (..., 3), m."""

    low: FloatArray
    high: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Workspace:
    """The reach of a chain's tip; make one by :meth:`of`.

    Attributes
    ----------
    chain : Chain
    pin : Box
        All vectors from pivot to tip lie in it, and touch each of its faces.
    """

    chain: Chain
    pin: Box

    @classmethod
    def of(cls, chain: Chain) -> Self:
        """Find the reach of ``chain``."""
        length, (sin_x, cos_x), (sin_y, cos_y) = _factors(chain)
        sides = np.array(
            [
                _product(length, _product(sin_y, cos_x)),
                _product(length, (-sin_x[1], -sin_x[0])),
                _product(length, _product(cos_x, cos_y)),
            ]
        )
        return cls(chain, Box(sides[:, 0], sides[:, 1]))

    @property
    def hull(self) -> Box:
        """The smallest box about all tip positions: nothing outside it is reachable."""
        chain = self.chain
        return Box(chain.lower[TABLES] + self.pin.low, chain.upper[TABLES] + self.pin.high)

    @property
    def core(self) -> Box:
        """The box of tip positions that are reachable whatever the nano joints are."""
        chain = self.chain
        return Box(chain.lower[TABLES] + self.pin.high, chain.upper[TABLES] + self.pin.low)

    @property
    def blur(self) -> float:
        """By how much :meth:`margin` may be too small, m: the bending of the nano reach."""
        length, (sin_x, cos_x), (sin_y, cos_y) = _factors(self.chain)
        longest, shortest = -length[0], -length[1]
        tilt_x, tilt_y = (max(abs(sine[0]), abs(sine[1])) for sine in (sin_x, sin_y))
        return max(
            tilt_y * (longest - shortest * cos_x[0]),
            tilt_x * (longest - shortest),
            longest * (1.0 - cos_x[0] * cos_y[0]),
        )

    def margin(self, tip: FloatArray) -> FloatArray:
        """Return how far (...), m, the tip (..., 3) is inside the reach; negative: outside.

        It is how far every table stays from its ends in a nano pose that spares them. From a
        reachable tip, any step that is no longer along x, y and z than this is reachable too.
        Never too great; too small by :attr:`blur` at most.
        """
        chain = self.chain
        away = np.asarray(tip, dtype=np.float64) - chain.centre[TABLES]
        bounds = (np.broadcast_to(b[NANO], away.shape) for b in (chain.lower, chain.upper))
        rest = away - tip_from_pivot(chain, aim(chain, away, *bounds).pose)
        half = 0.5 * (chain.upper - chain.lower)[TABLES]
        return np.asarray((half - np.abs(rest)).min(axis=-1))


_Interval = tuple[float, float]
_Intervals = tuple[_Interval, _Interval]


def _factors(chain: Chain) -> tuple[_Interval, _Intervals, _Intervals]:
    """Return the intervals of L, m, and of sine and cosine of thx and of thy."""
    length = float(chain.lower[5]) - chain.pin_length, float(chain.upper[5]) - chain.pin_length
    return length, _sine_cosine(chain, 3), _sine_cosine(chain, 4)


def _sine_cosine(chain: Chain, joint: int) -> _Intervals:
    """Return the intervals of sine and cosine of one tilt, both tilts below 90 degrees."""
    low, high = float(chain.lower[joint]), float(chain.upper[joint])
    cosines = float(np.cos(low)), float(np.cos(high))
    greatest = 1.0 if low <= 0.0 <= high else max(cosines)
    return (float(np.sin(low)), float(np.sin(high))), (min(cosines), greatest)


def _product(first: _Interval, second: _Interval) -> _Interval:
    ends = [a * b for a in first for b in second]
    return min(ends), max(ends)
