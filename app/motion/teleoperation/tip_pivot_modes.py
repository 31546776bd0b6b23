"""Tip modes: fine motion of the tip by tilts, and rotation about a fixed tip.

Only one of them is active at a time. Both are exact: each step solves the kinematics of
:mod:`rotemina.sim.kinematics`, and the speeds follow from the exact Jacobian J of
``p = [x, y, z] + L a(thx, thy)``.
"""

from abc import abstractmethod
from math import asin, cos, sin
from typing import ClassVar, NamedTuple, Self

import numpy as np

from rotemina.app.motion.teleoperation.frames import (
    FrameCoordinate,
    NamedValues,
    SteeringFrame,
    check_positions_known,
    find_axis_bounds,
)
from rotemina.app.motion.teleoperation.reference import CoordinateBounds
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import (
    JOINTS,
    NANO,
    TABLES,
    KinematicChain,
    angle_between_tool_axes,
    compute_tip_from_pivot,
    compute_tip_jacobian,
    compute_tip_position,
    solve_free_pose,
)

TIP_COORDINATES = ("x", "y", "z")
#: Maximum speed of a table while it compensates the nano stage, from measurements that
#: docs/teleoperation.md describes. At higher speeds the rate of the microsteps excites vibration of
#: the tables, and time offsets of a few ms between the boards matter more. The tip would then
#: deviate by more than 0.2 µm.
MAX_PIVOT_TABLE_SPEED_M_S = 8e-6
# Time in which this speed is reached, about one period of the vibration of the tables.
_PIVOT_RAMP_S = 0.01


class FrameAnchor(NamedTuple):
    """Start of a mode: the joints (6,), the tip position (3,), m, and the bounds of each joint."""

    joints: FloatArray
    tip: FloatArray
    bounds: dict[str, CoordinateBounds]

    @classmethod
    def at_joints(cls, chain: KinematicChain, joints: NamedValues) -> Self:
        """Return the anchor at joints, which are clipped to their ranges.

        Raises
        ------
        FrameError
            If the position of a joint is not known.
        """
        check_positions_known(JOINTS, joints)
        positions = np.clip([joints[axis] for axis in JOINTS], chain.lower, chain.upper)
        return cls(positions, compute_tip_position(chain, positions), find_axis_bounds(chain.robot))


class ChainFrame(SteeringFrame):
    """Base class of the frames of the hybrid chain. Create frames with ``begin_at``.

    Parameters
    ----------
    chain : KinematicChain
    anchor : FrameAnchor
    name, coordinates, axes
        See :class:`SteeringFrame`.

    Attributes
    ----------
    reserve_joints : slice
        Joints whose remaining range is reported.
    """

    reserve_joints: ClassVar[slice] = NANO

    def __init__(
        self,
        chain: KinematicChain,
        anchor: FrameAnchor,
        name: str,
        coordinates: tuple[FrameCoordinate, ...],
        axes: tuple[str, ...],
    ) -> None:
        super().__init__(name, coordinates, axes)
        self.chain = chain
        self.anchor = anchor

    @classmethod
    @abstractmethod
    def begin_at(cls, chain: KinematicChain, joints: NamedValues) -> Self:
        """Return the frame that begins at joints.

        Raises
        ------
        FrameError
            If the position of a joint is not known.
        """

    @abstractmethod
    def solve_joints(self, coordinates: NamedValues) -> FloatArray:
        """Return the joints (6,) for given coordinates."""

    def compute_joints(self, coordinates: NamedValues) -> dict[str, float]:
        """Return the joints of this mode's axes for given coordinates, clipped to their ranges."""
        joints = self.solve_joints(coordinates)
        clipped_joints = np.clip(joints, self.chain.lower, self.chain.upper).tolist()
        return {axis: clipped_joints[JOINTS.index(axis)] for axis in self.axes}

    def select_axis_speeds(self, speeds: FloatArray) -> dict[str, float]:
        """Return the speeds of this mode's axes from the speeds (6,) of all joints."""
        joint_speeds = speeds.tolist()
        return {axis: joint_speeds[JOINTS.index(axis)] for axis in self.axes}

    def compute_coordinate_speeds(self, speeds: NamedValues) -> dict[str, float]:
        """Return the velocity of the tip at the start of the mode from speeds of its axes."""
        joint_speeds = np.array(
            [speeds.get(axis, 0.0) if axis in self.axes else 0.0 for axis in JOINTS]
        )
        velocity = compute_tip_jacobian(self.chain, self.anchor.joints) @ joint_speeds
        return dict(zip(TIP_COORDINATES, velocity.tolist(), strict=True))

    def compute_reserve(self, coordinates: NamedValues) -> float:
        """Return the smallest remaining range of the reserve joints: 1 mid-range, 0 at an end."""
        positions = self.solve_joints(coordinates)[self.reserve_joints]
        low, high = self.chain.lower[self.reserve_joints], self.chain.upper[self.reserve_joints]
        reserve = np.minimum(positions - low, high - positions) / (0.5 * (high - low))
        return float(np.clip(reserve.min(), 0.0, 1.0))


class FineFrame(ChainFrame):
    """Frame of the tip position, m: the tilts move x and y, and zn moves z.

    The tables do not move. The mode changes the orientation of the tool.
    """

    @classmethod
    def begin_at(cls, chain: KinematicChain, joints: NamedValues) -> Self:
        """Return the frame that begins at joints; see :meth:`ChainFrame.begin_at`."""
        anchor = FrameAnchor.at_joints(chain, joints)
        *pivot, thx, thy, zn = anchor.joints.tolist()
        pin_offset, bounds = zn - chain.pin_length, anchor.bounds
        (x_low, y_low, zn_low), (x_high, y_high, zn_high) = chain.lower[NANO], chain.upper[NANO]
        # Range ends of the tip's x, y and z relative to the pivot, from those of thy, thx and zn.
        ends = (
            (pin_offset * sin(y_high) * cos(thx), pin_offset * sin(y_low) * cos(thx)),
            (-pin_offset * sin(x_low), -pin_offset * sin(x_high)),
            tuple((end - chain.pin_length) * cos(thx) * cos(thy) for end in (zn_low, zn_high)),
        )
        lever_arms = (("thy", -pin_offset), ("thx", -pin_offset), ("zn", 1.0))
        coordinates = tuple(
            FrameCoordinate.including_start(
                name,
                "m",
                CoordinateBounds(
                    float(origin + low),
                    float(origin + high),
                    bounds[axis].max_speed * lever_arm,
                    bounds[axis].max_acceleration * lever_arm,
                ),
                start,
            )
            for name, origin, (low, high), (axis, lever_arm), start in zip(
                TIP_COORDINATES, pivot, ends, lever_arms, anchor.tip.tolist(), strict=True
            )
        )
        return cls(chain, anchor, "fine", coordinates, ("thx", "thy", "zn"))

    def compute_axis_speeds(
        self, coordinates: NamedValues, velocities: NamedValues
    ) -> dict[str, float]:
        """Return the speeds of the tilts and zn, ``q̇ = J_nano⁻¹ ṗ``."""
        jacobian = compute_tip_jacobian(self.chain, self.solve_joints(coordinates))[:, NANO]
        nano = np.linalg.solve(jacobian, [velocities[name] for name in TIP_COORDINATES])
        return self.select_axis_speeds(np.concatenate([np.zeros(3), nano]))

    def compute_tilt(self, coordinates: NamedValues) -> float:
        """Return the angle by which the tool has turned since the start, rad."""
        return float(angle_between_tool_axes(self.anchor.joints, self.solve_joints(coordinates)))

    def solve_joints(self, coordinates: NamedValues) -> FloatArray:
        """Return the joints (6,) for a position of the tip."""
        tables = self.anchor.joints[TABLES]
        target = np.array([coordinates[name] for name in TIP_COORDINATES])
        return np.concatenate([tables, solve_free_pose(self.chain, target - tables)])


class PivotFrame(ChainFrame):
    """Frame of the tilts thx and thy, rad, about a fixed tip: the tables compensate the tilts.

    Within its range, zn compensates the few nm by which a tilt lifts the tip. A table could only
    make a whole microstep, and would ring.
    """

    reserve_joints = slice(3, 5)

    @classmethod
    def begin_at(cls, chain: KinematicChain, joints: NamedValues) -> Self:
        """Return the frame that begins at joints; see :meth:`ChainFrame.begin_at`."""
        anchor = FrameAnchor.at_joints(chain, joints)
        length = chain.pin_length - float(anchor.joints[5])
        coordinates = tuple(
            _make_tilt_coordinate(chain, anchor, *tilt, length)
            for tilt in (("thx", "y", 1.0), ("thy", "x", -1.0))
        )
        return cls(chain, anchor, "pivot", coordinates, JOINTS)

    def compute_axis_speeds(
        self, coordinates: NamedValues, velocities: NamedValues
    ) -> dict[str, float]:
        """Return the speeds that keep the tip at rest, ``J q̇ = 0``.

        zn compensates z while it is inside its range.
        """
        joints = self.solve_joints(coordinates)
        jacobian = compute_tip_jacobian(self.chain, joints)
        nano = np.array([velocities["thx"], velocities["thy"], 0.0])
        if self.chain.lower[5] < joints[5] < self.chain.upper[5]:
            nano[2] = -jacobian[2, 3:5] @ nano[:2] / jacobian[2, 5]
        return self.select_axis_speeds(np.concatenate([-jacobian[:, NANO] @ nano, nano]))

    def compute_coordinate_speeds(self, speeds: NamedValues) -> dict[str, float]:
        """Return the speeds of the tilts."""
        return {name: speeds.get(name, 0.0) for name in self.coordinates}

    def compute_tilt(self, coordinates: NamedValues) -> float:
        """Return the angle by which the tool has turned since the start, rad."""
        return float(angle_between_tool_axes(self.anchor.joints, self.solve_joints(coordinates)))

    def solve_joints(self, coordinates: NamedValues) -> FloatArray:
        """Return the joints (6,) that hold the tip for given tilts."""
        chain, (joints, tip, _) = self.chain, self.anchor
        thx, thy = coordinates["thx"], coordinates["thy"]
        height = (joints[5] - chain.pin_length) * np.cos(joints[3]) * np.cos(joints[4])
        zn = chain.pin_length + height / (cos(thx) * cos(thy))
        nano = np.array([thx, thy, np.clip(zn, chain.lower[5], chain.upper[5])])
        return np.concatenate([tip - compute_tip_from_pivot(chain, nano), nano])


def _make_tilt_coordinate(
    chain: KinematicChain, anchor: FrameAnchor, tilt: str, table: str, sign: float, length: float
) -> FrameCoordinate:
    """Return a tilt whose limits also keep the compensating table within its limits.

    The table moves by ``-sign · length`` per rad of tilt.
    """
    tilt_bounds, table_bounds = anchor.bounds[tilt], anchor.bounds[table]
    start = float(anchor.joints[JOINTS.index(tilt)])
    table_position = float(anchor.joints[JOINTS.index(table)])
    sines = [
        min(max(sin(start) - sign * (end - table_position) / length, -1.0), 1.0)
        for end in (table_bounds.low, table_bounds.high)
    ]
    low, high = sorted(map(asin, sines))
    speed = min(
        tilt_bounds.max_speed, table_bounds.max_speed / length, MAX_PIVOT_TABLE_SPEED_M_S / length
    )
    acceleration = min(
        tilt_bounds.max_acceleration, table_bounds.max_acceleration / length, speed / _PIVOT_RAMP_S
    )
    low, high = min(max(tilt_bounds.low, low), start), max(min(tilt_bounds.high, high), start)
    return FrameCoordinate(tilt, "rad", CoordinateBounds(low, high, speed, acceleration), start)
