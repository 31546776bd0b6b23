"""Past positions of the tip, and places that it can be sent to. Free of Qt."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.robot.model import Robot

MOST_POINTS = 20_000  # of a trail; half of them go when it is full
LEAST_M = 5e-7  # between two points
LARGE = 0.1  # of a range; a way that is longer is asked about


class PlaceKind(StrEnum):
    """What a place on the map is."""

    SAVED = "saved"
    CELL = "cell"
    FREE = "free"


@dataclass(frozen=True, slots=True)
class MapPlace:
    """One place: where the tip is there (3,), m, and where axes are, m or rad.

    Of a free place those are the two that lead there; the others stay.
    """

    kind: PlaceKind
    name: str
    tip_m: tuple[float, float, float]
    targets: Mapping[str, float]
    outcome: str = ""


class Trail:
    """Where the tip was, oldest first; a way shorter than :data:`LEAST_M` adds nothing."""

    def __init__(self) -> None:
        self._points = np.empty((MOST_POINTS, 3))
        self._count = 0

    @property
    def points(self) -> FloatArray:
        """All of them (n, 3), m."""
        return self._points[: self._count]

    def add(self, tip_m: FloatArray) -> bool:
        """Add where the tip is; return whether it has moved."""
        if self._count and np.abs(tip_m - self._points[self._count - 1]).max() < LEAST_M:
            return False
        if self._count == MOST_POINTS:
            self._count = MOST_POINTS // 2
            self._points[: self._count] = self._points[::2].copy()
        self._points[self._count] = tip_m
        self._count += 1
        return True

    def clear(self) -> None:
        """Forget where it was."""
        self._count = 0


class TipMap:
    """The tip of one robot, by its kinematics.

    Raises
    ------
    ChainError
        If the robot has none.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.chain = Chain.of(robot)
        axes = tuple(robot.axes)
        self._across = tuple(axes[column] for column in self.chain.columns[:2])

    def tip(self, positions: Mapping[str, float]) -> FloatArray | None:
        """Return where the tip is (3,), m; None where a position is not known."""
        if any(axis not in positions for axis in self._robot.axes):
            return None
        order = np.array([positions[axis] for axis in self._robot.axes])
        tip = tip_position(self.chain, self.chain.joints_of(order))
        return tip if np.isfinite(tip).all() else None

    def place(
        self, kind: PlaceKind, name: str, targets: Mapping[str, float], outcome: str = ""
    ) -> MapPlace | None:
        """Return a place of all axes."""
        tip = self.tip(targets)
        return None if tip is None else MapPlace(kind, name, _vector(tip), targets, outcome)

    def free(self, x: float, y: float, command: Mapping[str, float]) -> MapPlace | None:
        """Return the place above x and y, m, to which the tables lead; the tip keeps its height."""
        tip = self.tip(command)
        if tip is None:
            return None
        ways = zip(self._across, (x, y), tip[:2], strict=True)
        targets = {axis: command[axis] + float(to - now) for axis, to, now in ways}
        at = (x, y, float(tip[2]))
        return MapPlace(PlaceKind.FREE, "", at, MappingProxyType(targets))

    def large(self, place: MapPlace, command: Mapping[str, float]) -> bool:
        """Whether an axis goes farther than a move that nobody is asked about."""
        axes = self._robot.axes
        return any(
            abs(to - command[axis]) > LARGE * axes[axis].span
            for axis, to in place.targets.items()
            if axis in command
        )


def _vector(tip: FloatArray) -> tuple[float, float, float]:
    return (float(tip[0]), float(tip[1]), float(tip[2]))
