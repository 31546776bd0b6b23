"""Past positions of the tip, and places to which it can be sent. This module does not use Qt."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import KinematicChain, compute_tip_position
from rotemina.sim.robot import Robot

#: A full trail is thinned: every second point is dropped.
MAX_TRAIL_POINTS = 20_000
MIN_TRAIL_STEP_M = 5e-7
#: A longer move needs a confirmation. The length is relative to the range of the axis.
MAX_UNCONFIRMED_RATIO = 0.1


class PlaceKind(StrEnum):
    """Kind of a place on the map."""

    SAVED = "saved"
    CELL = "cell"
    FREE = "free"


@dataclass(frozen=True, slots=True)
class MapPlace:
    """Place on the map: position of the tip (3,), m, and targets of the axes, m or rad.

    A free place has targets only for the two axes that lead there. The others stay.
    """

    kind: PlaceKind
    name: str
    tip_m: tuple[float, float, float]
    targets: Mapping[str, float]
    outcome: str = ""


class TipTrail:
    """Past positions of the tip, oldest first, at least :data:`MIN_TRAIL_STEP_M` apart."""

    def __init__(self) -> None:
        self._points = np.empty((MAX_TRAIL_POINTS, 3))
        self._count = 0

    @property
    def points(self) -> FloatArray:
        """All points (n, 3), m."""
        return self._points[: self._count]

    def add(self, tip_m: FloatArray) -> bool:
        """Add a position of the tip (3,), m, if it is far enough from the last one.

        Return whether it was added.
        """
        if self._count and np.abs(tip_m - self._points[self._count - 1]).max() < MIN_TRAIL_STEP_M:
            return False
        if self._count == MAX_TRAIL_POINTS:
            self._count = MAX_TRAIL_POINTS // 2
            self._points[: self._count] = self._points[::2].copy()
        self._points[self._count] = tip_m
        self._count += 1
        return True

    def clear(self) -> None:
        """Remove all points."""
        self._count = 0


class TipMap:
    """Map of the tip of one robot, based on its kinematics.

    Raises
    ------
    ChainError
        If the robot has no kinematics.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.chain = KinematicChain.of(robot)
        axes = tuple(robot.axes)
        self._table_axes = tuple(axes[column] for column in self.chain.columns[:2])

    def compute_tip(self, positions: Mapping[str, float]) -> FloatArray | None:
        """Return the position of the tip (3,), m; None if the position of an axis is unknown."""
        if any(axis not in positions for axis in self._robot.axes):
            return None
        axis_positions = np.array([positions[axis] for axis in self._robot.axes])
        tip = compute_tip_position(self.chain, self.chain.select_joints(axis_positions))
        return tip if np.isfinite(tip).all() else None

    def make_place(
        self, kind: PlaceKind, name: str, targets: Mapping[str, float], outcome: str = ""
    ) -> MapPlace | None:
        """Return the place with these targets of all axes, or None if the tip there is unknown."""
        tip = self.compute_tip(targets)
        return None if tip is None else MapPlace(kind, name, _to_tuple(tip), targets, outcome)

    def make_free_place(self, x: float, y: float, command: Mapping[str, float]) -> MapPlace | None:
        """Return the free place at x and y, m, which the tables reach at the current tip height."""
        tip = self.compute_tip(command)
        if tip is None:
            return None
        coordinates = zip(self._table_axes, (x, y), tip[:2], strict=True)
        targets = {
            axis: command[axis] + float(target - current) for axis, target, current in coordinates
        }
        position = (x, y, float(tip[2]))
        return MapPlace(PlaceKind.FREE, "", position, MappingProxyType(targets))

    def is_large_move(self, place: MapPlace, command: Mapping[str, float]) -> bool:
        """Return whether the move of an axis is so long that it needs a confirmation."""
        axes = self._robot.axes
        return any(
            abs(target - command[axis]) > MAX_UNCONFIRMED_RATIO * axes[axis].span
            for axis, target in place.targets.items()
            if axis in command
        )


def _to_tuple(tip: FloatArray) -> tuple[float, float, float]:
    return (float(tip[0]), float(tip[1]), float(tip[2]))
