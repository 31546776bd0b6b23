"""Modes around the tip: fine x, y by tilt, and rotation about a fixed tip; mutually exclusive.

Both are exact: the kinematics of :mod:`rotemina.sim.kinematics` are solved at every step, and
speeds are by the exact Jacobian J of ``p = [x, y, z] + L a(thx, thy)``.
"""

from abc import abstractmethod
from math import asin, cos, sin
from typing import ClassVar, NamedTuple, Self

import numpy as np

from rotemina.app.motion.teleoperation.frames import (
    Coordinate,
    Frame,
    Values,
    axis_bounds,
    check_known,
)
from rotemina.app.motion.teleoperation.reference import Bounds
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.aiming import free_pose
from rotemina.sim.kinematics.chain import JOINTS, NANO, TABLES, Chain
from rotemina.sim.kinematics.forward import (
    tip_from_pivot,
    tip_jacobian,
    tip_position,
    turned_angle,
)

TIP = ("x", "y", "z")
#: How fast a table may go while it holds the tip against the nano stage, m/s. Measured, see
#: docs/teleoperation.md: faster, microsteps come at the rate at which the tables ring, and a few ms
#: between the boards weigh more, so that the tip strays by more than 0.2 µm.
PIVOT_TABLE_SPEED = 8e-6
_PIVOT_RAMP_S = 0.01  # to that speed: about a period of the tables' vibration


class Anchor(NamedTuple):
    """Joints (6,) at which a mode begins, the tip (3,) there, m, and the bounds of each joint."""

    joints: FloatArray
    tip: FloatArray
    bounds: dict[str, Bounds]

    @classmethod
    def at(cls, chain: Chain, joints: Values) -> Self:
        """Return the anchor at joints, which count as the nearest inside their ranges.

        Raises
        ------
        FrameError
            If the place of a joint is not known.
        """
        check_known(JOINTS, joints)
        place = np.clip([joints[axis] for axis in JOINTS], chain.lower, chain.upper)
        return cls(place, tip_position(chain, place), axis_bounds(chain.robot))


class ChainFrame(Frame):
    """A frame of the hybrid chain; make one by a subclass' ``at``.

    Parameters
    ----------
    chain : Chain
    anchor : Anchor
    name, coordinates, axes
        As of :class:`Frame`.

    Attributes
    ----------
    shared : slice
        The joints whose reserve of range is told.
    """

    shared: ClassVar[slice] = NANO

    def __init__(
        self,
        chain: Chain,
        anchor: Anchor,
        name: str,
        coordinates: tuple[Coordinate, ...],
        axes: tuple[str, ...],
    ) -> None:
        super().__init__(name, coordinates, axes)
        self.chain = chain
        self.anchor = anchor

    @classmethod
    @abstractmethod
    def at(cls, chain: Chain, joints: Values) -> Self:
        """Begin at joints.

        Raises
        ------
        FrameError
            If the place of a joint is not known.
        """

    @abstractmethod
    def solved(self, coordinates: Values) -> FloatArray:
        """Return the joints (6,) at these coordinates."""

    def joints(self, coordinates: Values) -> dict[str, float]:
        """Return the joints of this mode's axes at these coordinates."""
        solved = self.solved(coordinates)
        inside = np.clip(solved, self.chain.lower, self.chain.upper).tolist()
        return {axis: inside[JOINTS.index(axis)] for axis in self.axes}

    def named_speeds(self, speeds: FloatArray) -> dict[str, float]:
        """Return what speeds (6,) of joints mean for the axes of this mode."""
        every = speeds.tolist()
        return {axis: every[JOINTS.index(axis)] for axis in self.axes}

    def velocities(self, speeds: Values) -> dict[str, float]:
        """Return the velocity of the tip at the start from speeds of this mode's axes."""
        joints = np.array([speeds.get(a, 0.0) if a in self.axes else 0.0 for a in JOINTS])
        velocity = tip_jacobian(self.chain, self.anchor.joints) @ joints
        return dict(zip(TIP, velocity.tolist(), strict=True))

    def reserve(self, coordinates: Values) -> float:
        """Return how much of its range the shared joint has that has least, to its nearer end."""
        place = self.solved(coordinates)[self.shared]
        low, high = self.chain.lower[self.shared], self.chain.upper[self.shared]
        left = np.minimum(place - low, high - place) / (0.5 * (high - low))
        return float(np.clip(left.min(), 0.0, 1.0))


class FineFrame(ChainFrame):
    """The tip's x, y by tilt and z by zn, m; the tables stay. It costs orientation."""

    @classmethod
    def at(cls, chain: Chain, joints: Values) -> Self:
        """Begin at joints; errors as of :meth:`ChainFrame.at`."""
        anchor = Anchor.at(chain, joints)
        *pivot, thx, thy, zn = anchor.joints.tolist()
        length, bounds = zn - chain.pin_length, anchor.bounds
        (x_low, y_low, zn_low), (x_high, y_high, zn_high) = chain.lower[NANO], chain.upper[NANO]
        ends = (
            (length * sin(y_high) * cos(thx), length * sin(y_low) * cos(thx)),
            (-length * sin(x_low), -length * sin(x_high)),
            tuple((end - chain.pin_length) * cos(thx) * cos(thy) for end in (zn_low, zn_high)),
        )
        levers = (("thy", -length), ("thx", -length), ("zn", 1.0))
        coordinates = tuple(
            Coordinate.of(
                name,
                "m",
                Bounds(
                    float(at + low),
                    float(at + high),
                    bounds[axis].max_speed * lever,
                    bounds[axis].max_acceleration * lever,
                ),
                start,
            )
            for name, at, (low, high), (axis, lever), start in zip(
                TIP, pivot, ends, levers, anchor.tip.tolist(), strict=True
            )
        )
        return cls(chain, anchor, "fine", coordinates, ("thx", "thy", "zn"))

    def speeds(self, coordinates: Values, velocities: Values) -> dict[str, float]:
        """Return the speeds of tilts and zn: ``q̇ = J_nano⁻¹ ṗ``."""
        jacobian = tip_jacobian(self.chain, self.solved(coordinates))[:, NANO]
        nano = np.linalg.solve(jacobian, [velocities[name] for name in TIP])
        return self.named_speeds(np.concatenate([np.zeros(3), nano]))

    def tilt(self, coordinates: Values) -> float:
        """Return the turn of the tool since the start."""
        return float(turned_angle(self.anchor.joints, self.solved(coordinates)))

    def solved(self, coordinates: Values) -> FloatArray:
        """Return the joints (6,) whose tilts and zn put the tip there."""
        tables = self.anchor.joints[TABLES]
        target = np.array([coordinates[name] for name in TIP])
        return np.concatenate([tables, free_pose(self.chain, target - tables)])


class PivotFrame(ChainFrame):
    """The tilts thx, thy, rad, about a tip that stays: the tables make up for them.

    The few nm by which a tilt lifts the tip are zn's, as far as it reaches: a table would have to
    step by a whole microstep, and ring.
    """

    shared = slice(3, 5)

    @classmethod
    def at(cls, chain: Chain, joints: Values) -> Self:
        """Begin at joints; errors as of :meth:`ChainFrame.at`."""
        anchor = Anchor.at(chain, joints)
        length = chain.pin_length - float(anchor.joints[5])
        coordinates = tuple(
            _tilt_coordinate(chain, anchor, *one, length)
            for one in (("thx", "y", 1.0), ("thy", "x", -1.0))
        )
        return cls(chain, anchor, "pivot", coordinates, JOINTS)

    def speeds(self, coordinates: Values, velocities: Values) -> dict[str, float]:
        """Return the speeds that leave the tip at rest: ``J q̇ = 0``, z's by zn while it reaches."""
        joints = self.solved(coordinates)
        jacobian = tip_jacobian(self.chain, joints)
        nano = np.array([velocities["thx"], velocities["thy"], 0.0])
        if self.chain.lower[5] < joints[5] < self.chain.upper[5]:
            nano[2] = -jacobian[2, 3:5] @ nano[:2] / jacobian[2, 5]
        return self.named_speeds(np.concatenate([-jacobian[:, NANO] @ nano, nano]))

    def velocities(self, speeds: Values) -> dict[str, float]:
        """Return the speeds of the tilts."""
        return {name: speeds.get(name, 0.0) for name in self.coordinates}

    def tilt(self, coordinates: Values) -> float:
        """Return the turn of the tool since the start."""
        return float(turned_angle(self.anchor.joints, self.solved(coordinates)))

    def solved(self, coordinates: Values) -> FloatArray:
        """Return the joints (6,) that hold the tip at these tilts."""
        chain, (joints, tip, _) = self.chain, self.anchor
        thx, thy = coordinates["thx"], coordinates["thy"]
        level = (joints[5] - chain.pin_length) * np.cos(joints[3]) * np.cos(joints[4])
        zn = chain.pin_length + level / (cos(thx) * cos(thy))
        nano = np.array([thx, thy, np.clip(zn, chain.lower[5], chain.upper[5])])
        return np.concatenate([tip - tip_from_pivot(chain, nano), nano])


def _tilt_coordinate(
    chain: Chain, anchor: Anchor, tilt: str, table: str, sign: float, length: float
) -> Coordinate:
    """Return a tilt's bounds where the table, which it moves by ``-sign · length``, has room."""
    own, carried = anchor.bounds[tilt], anchor.bounds[table]
    start = float(anchor.joints[JOINTS.index(tilt)])
    at = float(anchor.joints[JOINTS.index(table)])
    sines = [
        min(max(sin(start) - sign * (end - at) / length, -1.0), 1.0)
        for end in (carried.low, carried.high)
    ]
    low, high = sorted(map(asin, sines))
    speed = min(own.max_speed, carried.max_speed / length, PIVOT_TABLE_SPEED / length)
    acceleration = min(
        own.max_acceleration, carried.max_acceleration / length, speed / _PIVOT_RAMP_S
    )
    low, high = min(max(own.low, low), start), max(min(own.high, high), start)
    return Coordinate(tilt, "rad", Bounds(low, high, speed, acceleration), start)
