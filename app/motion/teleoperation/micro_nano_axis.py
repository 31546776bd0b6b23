"""Table and piezo as one axis: the piezo moves within its range, the table does the rest.

With u the place that zn would have if its range had no ends, counted from its middle::

    zn = S(u),     u = u0 + (h − h0)/a_z,     z = h − (S(u) − pin_length) a_z

S has slope 1 over the inner half of the range, and its slope then falls to 0, along
``1 − 3s² + 2s³``, where the end is reached; there the table does all of it. zn depends on the
height h of the tip alone: there is no hysteresis, and going back the same way brings all joints
back. The tip's speed is what was asked at any place; that the table takes over costs it at most
``ḣ² max|S''|``, which bounds the speed of this mode.
"""

from math import copysign, cos, sqrt
from typing import Self

import numpy as np
import scipy

from rotemina.app.motion.teleoperation.frames import Coordinate, Values
from rotemina.app.motion.teleoperation.reference import Bounds
from rotemina.app.motion.teleoperation.tip_pivot_modes import TIP, Anchor, ChainFrame
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import JOINTS, NANO, Chain
from rotemina.sim.kinematics.forward import tip_from_pivot, tip_jacobian

_ATOM = 1e-12  # m, that a height may be beyond the table's end


class Saturation:
    """S: what a piezo takes of a motion, between its ends ``low`` and ``high``, m."""

    def __init__(self, low: float, high: float) -> None:
        self._middle = 0.5 * (low + high)
        self._half = 0.5 * (high - low)
        self._inner = 0.5 * self._half
        # The slope falls over twice the way that is left: its mean there is a half.
        self._fall = 2.0 * (self._half - self._inner)

    @property
    def end(self) -> float:
        """Distance of u from the middle of the range at which an end is reached."""
        return self._inner + self._fall

    @property
    def bend(self) -> float:
        """Greatest |S''|, 1/m."""
        return 1.5 / self._fall

    def place(self, u: float) -> float:
        """Return S(u)."""
        size = abs(u)
        if size > self._inner:
            s = min((size - self._inner) / self._fall, 1.0)
            size = self._inner + self._fall * (s - s**3 + 0.5 * s**4)
        return self._middle + copysign(size, u)

    def slope(self, u: float) -> float:
        """Return S'(u)."""
        s = min(max((abs(u) - self._inner) / self._fall, 0.0), 1.0)
        return 1.0 - s * s * (3.0 - 2.0 * s)

    def inverse(self, place: float) -> float:
        """Return the u nearest to the middle at which the piezo is there."""
        away = place - self._middle
        if abs(away) <= self._inner:
            return away
        if abs(away) >= self._half:
            return copysign(self.end, away)
        root = scipy.optimize.brentq(
            lambda u: self.place(u) - self._middle - abs(away), self._inner, self.end, xtol=1e-16
        )
        return copysign(float(root), away)


class HybridFrame(ChainFrame):
    """The tip's x, y by the tables, and its z by zn and the table z; m. The tilts stay."""

    shared = slice(5, 6)

    def __init__(self, chain: Chain, anchor: Anchor) -> None:
        tilts = anchor.joints[3:5].tolist()
        self._saturation = Saturation(float(chain.lower[5]), float(chain.upper[5]))
        self._rise = cos(tilts[0]) * cos(tilts[1])
        self._begin = self._saturation.inverse(float(anchor.joints[5]))
        height = self._height(chain, anchor)
        sides = (_beside(anchor, name) for name in TIP[:2])
        super().__init__(chain, anchor, "hybrid", (*sides, height), ("x", "y", "z", "zn"))

    @classmethod
    def at(cls, chain: Chain, joints: Values) -> Self:
        """Begin at joints; errors as of :meth:`ChainFrame.at`."""
        return cls(chain, Anchor.at(chain, joints))

    def speeds(self, coordinates: Values, velocities: Values) -> dict[str, float]:
        """Return ``żn = S' ḣ/a_z``, and the tables' ``ṗ − a żn``."""
        joints = self.solved(coordinates)
        zn = self._saturation.slope(self._u(coordinates["z"])) * velocities["z"] / self._rise
        tool = tip_jacobian(self.chain, joints)[:, 5]
        tables = np.array([velocities[name] for name in TIP]) - tool * zn
        return self.named_speeds(np.concatenate([tables, [0.0, 0.0, zn]]))

    def _u(self, height: float) -> float:
        return self._begin + (height - float(self.anchor.tip[2])) / self._rise

    def solved(self, coordinates: Values) -> FloatArray:
        """Return the joints (6,) that put the tip there."""
        nano = self.anchor.joints[NANO].copy()
        # The anchor itself to the last bit: nothing moves by beginning.
        begin = self._saturation.place(self._begin)
        nano[2] += self._saturation.place(self._u(coordinates["z"])) - begin
        target = np.array([coordinates[name] for name in TIP])
        return np.concatenate([target - tip_from_pivot(self.chain, nano), nano])

    def _height(self, chain: Chain, anchor: Anchor) -> Coordinate:
        """Return the bounds of the tip's height."""
        table, piezo = anchor.bounds["z"], anchor.bounds["zn"]
        z, zn = float(anchor.joints[2]), float(anchor.joints[5])
        ends = []
        for end, last in (
            (table.low, float(chain.lower[5])),
            (table.high, float(chain.upper[5])),
        ):
            farthest = (end - z) + (last - zn) * self._rise

            def beyond(way: float, end: float = end, farthest: float = farthest) -> float:
                taken = self._saturation.place(self._begin + way / self._rise) - zn
                return copysign(1.0, farthest) * (z + way - taken * self._rise - end) - _ATOM

            ends.append(
                farthest
                if beyond(farthest) <= 0.0
                else scipy.optimize.brentq(beyond, 0.0, farthest)
            )
        acceleration = 0.5 * min(table.max_acceleration, piezo.max_acceleration)
        # The other half is for what the bend of S adds to the table's.
        speed = min(table.max_speed, piezo.max_speed, sqrt(acceleration / self._saturation.bend))
        start = float(anchor.tip[2])
        bounds = Bounds(start + float(ends[0]), start + float(ends[1]), speed, acceleration)
        return Coordinate.of("z", "m", bounds, start)


def _beside(anchor: Anchor, name: str) -> Coordinate:
    """Return x or y of the tip: the table's bounds, beside which the tip is."""
    table = anchor.bounds[name]
    start = float(anchor.tip[TIP.index(name)])
    beside = start - float(anchor.joints[JOINTS.index(name)])
    bounds = Bounds(
        table.low + beside, table.high + beside, table.max_speed, table.max_acceleration
    )
    return Coordinate.of(name, "m", bounds, start)
