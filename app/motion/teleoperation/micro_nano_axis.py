"""Table and piezo as one axis: the piezo moves within its range, and the table does the rest.

Let u be the position that zn would have if its range were unlimited, measured from mid-range::

    zn = S(u),     u = u0 + (h − h0)/a_z,     z = h − (S(u) − pin_length) a_z

S has slope 1 over the inner half of the range. From there its slope falls to 0 along
``1 − 3s² + 2s³`` until the end is reached, where the table makes the whole motion. zn depends only
on the height h of the tip. So there is no hysteresis: moving back restores all joints. The tip has
the requested speed everywhere. While the table takes over, it needs an additional acceleration of
at most ``ḣ² max|S''|``, which limits the speed of this mode.
"""

from math import copysign, cos, sqrt
from typing import Self

import numpy as np
import scipy

from rotemina.app.motion.teleoperation.frames import FrameCoordinate, NamedValues
from rotemina.app.motion.teleoperation.reference import CoordinateBounds
from rotemina.app.motion.teleoperation.tip_pivot_modes import (
    TIP_COORDINATES,
    ChainFrame,
    FrameAnchor,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import (
    JOINTS,
    NANO,
    KinematicChain,
    compute_tip_from_pivot,
    compute_tip_jacobian,
)

# Due to rounding, a height may be beyond the end of the table by this much.
_HEIGHT_TOLERANCE_M = 1e-12


class PiezoSaturation:
    """The function S: position of a piezo with the ends ``low`` and ``high``, m, in a motion."""

    def __init__(self, low: float, high: float) -> None:
        self._middle = 0.5 * (low + high)
        self._half_range = 0.5 * (high - low)
        self._linear_half_range = 0.5 * self._half_range
        # The mean slope in the transition is ½, so the transition is twice as long as the remaining
        # range.
        self._transition_length = 2.0 * (self._half_range - self._linear_half_range)

    @property
    def end_distance(self) -> float:
        """Distance of u from the middle of the range at which S reaches an end, m."""
        return self._linear_half_range + self._transition_length

    @property
    def max_curvature(self) -> float:
        """Maximum of |S''|, 1/m."""
        return 1.5 / self._transition_length

    def compute_position(self, u: float) -> float:
        """Return S(u)."""
        distance = abs(u)
        if distance > self._linear_half_range:
            s = min((distance - self._linear_half_range) / self._transition_length, 1.0)
            distance = self._linear_half_range + self._transition_length * (s - s**3 + 0.5 * s**4)
        return self._middle + copysign(distance, u)

    def compute_slope(self, u: float) -> float:
        """Return S'(u)."""
        s = min(max((abs(u) - self._linear_half_range) / self._transition_length, 0.0), 1.0)
        return 1.0 - s * s * (3.0 - 2.0 * s)

    def invert(self, position: float) -> float:
        """Return the u of smallest magnitude at which the piezo has a position, m."""
        offset = position - self._middle
        if abs(offset) <= self._linear_half_range:
            return offset
        if abs(offset) >= self._half_range:
            return copysign(self.end_distance, offset)
        root = scipy.optimize.brentq(
            lambda u: self.compute_position(u) - self._middle - abs(offset),
            self._linear_half_range,
            self.end_distance,
            xtol=1e-16,
        )
        return copysign(float(root), offset)


class HybridFrame(ChainFrame):
    """Frame of the tip position, m: the tables move x and y, and zn and the table z move z.

    The tilts do not move.
    """

    reserve_joints = slice(5, 6)

    def __init__(self, chain: KinematicChain, anchor: FrameAnchor) -> None:
        tilts = anchor.joints[3:5].tolist()
        self._saturation = PiezoSaturation(float(chain.lower[5]), float(chain.upper[5]))
        self._axial_z = cos(tilts[0]) * cos(tilts[1])
        self._start_u = self._saturation.invert(float(anchor.joints[5]))
        height = self._make_height_coordinate(chain, anchor)
        lateral = (_make_lateral_coordinate(anchor, name) for name in TIP_COORDINATES[:2])
        super().__init__(chain, anchor, "hybrid", (*lateral, height), ("x", "y", "z", "zn"))

    @classmethod
    def begin_at(cls, chain: KinematicChain, joints: NamedValues) -> Self:
        """Return the frame that begins at joints; see :meth:`ChainFrame.begin_at`."""
        return cls(chain, FrameAnchor.at_joints(chain, joints))

    def compute_axis_speeds(
        self, coordinates: NamedValues, velocities: NamedValues
    ) -> dict[str, float]:
        """Return the speed of zn, ``żn = S' ḣ/a_z``, and of the tables, ``ṗ − a żn``."""
        joints = self.solve_joints(coordinates)
        zn_speed = (
            self._saturation.compute_slope(self._compute_u(coordinates["z"]))
            * velocities["z"]
            / self._axial_z
        )
        tool_direction = compute_tip_jacobian(self.chain, joints)[:, 5]
        table_speeds = (
            np.array([velocities[name] for name in TIP_COORDINATES]) - tool_direction * zn_speed
        )
        return self.select_axis_speeds(np.concatenate([table_speeds, [0.0, 0.0, zn_speed]]))

    def _compute_u(self, height: float) -> float:
        return self._start_u + (height - float(self.anchor.tip[2])) / self._axial_z

    def solve_joints(self, coordinates: NamedValues) -> FloatArray:
        """Return the joints (6,) for a position of the tip."""
        nano = self.anchor.joints[NANO].copy()
        # This form gives exactly the joints of the anchor at the start, so nothing moves there.
        start_position = self._saturation.compute_position(self._start_u)
        nano[2] += (
            self._saturation.compute_position(self._compute_u(coordinates["z"])) - start_position
        )
        target = np.array([coordinates[name] for name in TIP_COORDINATES])
        return np.concatenate([target - compute_tip_from_pivot(self.chain, nano), nano])

    def _make_height_coordinate(
        self, chain: KinematicChain, anchor: FrameAnchor
    ) -> FrameCoordinate:
        """Return the coordinate z, bounded by the heights that table and piezo can reach."""
        table, piezo = anchor.bounds["z"], anchor.bounds["zn"]
        z, zn = float(anchor.joints[2]), float(anchor.joints[5])
        travels = []
        for table_end, piezo_end in (
            (table.low, float(chain.lower[5])),
            (table.high, float(chain.upper[5])),
        ):
            max_travel = (table_end - z) + (piezo_end - zn) * self._axial_z

            def compute_excess(
                travel: float, table_end: float = table_end, max_travel: float = max_travel
            ) -> float:
                zn_travel = (
                    self._saturation.compute_position(self._start_u + travel / self._axial_z) - zn
                )
                return (
                    copysign(1.0, max_travel) * (z + travel - zn_travel * self._axial_z - table_end)
                    - _HEIGHT_TOLERANCE_M
                )

            travels.append(
                max_travel
                if compute_excess(max_travel) <= 0.0
                else scipy.optimize.brentq(compute_excess, 0.0, max_travel)
            )
        acceleration = 0.5 * min(table.max_acceleration, piezo.max_acceleration)
        # The other half is reserved for the acceleration that the curvature of S adds.
        speed = min(
            table.max_speed, piezo.max_speed, sqrt(acceleration / self._saturation.max_curvature)
        )
        start = float(anchor.tip[2])
        bounds = CoordinateBounds(
            start + float(travels[0]), start + float(travels[1]), speed, acceleration
        )
        return FrameCoordinate.including_start("z", "m", bounds, start)


def _make_lateral_coordinate(anchor: FrameAnchor, name: str) -> FrameCoordinate:
    """Return x or y of the tip, bounded by the range of its table plus the tip's offset."""
    table = anchor.bounds[name]
    start = float(anchor.tip[TIP_COORDINATES.index(name)])
    offset = start - float(anchor.joints[JOINTS.index(name)])
    bounds = CoordinateBounds(
        table.low + offset, table.high + offset, table.max_speed, table.max_acceleration
    )
    return FrameCoordinate.including_start(name, "m", bounds, start)
