"""Frames: mappings of the operator's coordinates to joints, one for each mode.

A frame is anchored at the joint positions where its mode begins. Its coordinates there are its
``start``, and :meth:`SteeringFrame.compute_joints` maps ``start`` exactly to these joints.
Therefore a change of modes does not move the machine: the new frame begins at the current commands,
and the laws begin at its ``start`` with the speeds from
:meth:`SteeringFrame.compute_coordinate_speeds`.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Self

from rotemina.app.errors import FrameError
from rotemina.app.motion.teleoperation.reference import CoordinateBounds
from rotemina.sim.messages import (
    AxisName,
    join_messages,
)
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import SetpointLimits

NamedValues = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class FrameCoordinate:
    """Coordinate of a mode: name, unit (m or rad), bounds, and value where the mode begins."""

    name: str
    unit: str
    bounds: CoordinateBounds
    start: float

    @classmethod
    def including_start(cls, name: str, unit: str, bounds: CoordinateBounds, start: float) -> Self:
        """Return a coordinate whose range includes its start in spite of rounding errors."""
        low, high = min(bounds.low, start), max(bounds.high, start)
        return cls(name, unit, replace(bounds, low=low, high=high), start)


class SteeringFrame(ABC):
    """Mapping of the coordinates of a mode to joints.

    Attributes
    ----------
    name : str
        Name of the mode.
    coordinates : mapping of str to FrameCoordinate
        Coordinates by name. The axes x, y, z of a stick move them in this order, unless a profile
        says otherwise.
    axes : tuple of str
        The robot's axes that the mode moves. The others stand still.
    """

    def __init__(
        self, name: str, coordinates: tuple[FrameCoordinate, ...], axes: tuple[str, ...]
    ) -> None:
        self.name = name
        self.coordinates = MappingProxyType(
            {coordinate.name: coordinate for coordinate in coordinates}
        )
        self.axes = axes

    @property
    def start(self) -> dict[str, float]:
        """The coordinates at which the mode began."""
        return {name: coordinate.start for name, coordinate in self.coordinates.items()}

    @abstractmethod
    def compute_joints(self, coordinates: NamedValues) -> dict[str, float]:
        """Return the axis positions for given coordinates, m or rad, clipped to the ranges."""

    @abstractmethod
    def compute_axis_speeds(
        self, coordinates: NamedValues, velocities: NamedValues
    ) -> dict[str, float]:
        """Return the axis speeds for given coordinates and their velocities, per s."""

    @abstractmethod
    def compute_coordinate_speeds(self, speeds: NamedValues) -> dict[str, float]:
        """Return the velocities of the coordinates at the start for given axis speeds.

        Motion that no coordinate describes is left out; the caller must stop it.
        """

    def compute_reserve(self, coordinates: NamedValues) -> float | None:
        """Return the remaining range of the piezos: 1 in mid-range, 0 at an end.

        Return None if no piezo takes part in the motion.
        """
        return None

    def compute_tilt(self, coordinates: NamedValues) -> float | None:
        """Return the angle by which the mode has turned the tool, rad; None if it never turns."""
        return None


class AxesFrame(SteeringFrame):
    """Frame of one stage, in which each coordinate is an axis.

    Parameters
    ----------
    robot : Robot
    name : str
    axes : tuple of str
    joints : mapping of str to float
        Current axis positions, m or rad.

    Raises
    ------
    FrameError
        If the position of an axis is not known.
    """

    def __init__(self, robot: Robot, name: str, axes: tuple[str, ...], joints: NamedValues) -> None:
        check_positions_known(axes, joints)
        bounds = find_axis_bounds(robot)
        coordinates = tuple(
            FrameCoordinate(
                axis, robot.unit(axis) or "m", bounds[axis], bounds[axis].clip(joints[axis])
            )
            for axis in axes
        )
        super().__init__(name, coordinates, axes)

    def compute_joints(self, coordinates: NamedValues) -> dict[str, float]:
        """Return the coordinates, clipped to the ranges of the axes."""
        return {axis: self.coordinates[axis].bounds.clip(coordinates[axis]) for axis in self.axes}

    def compute_axis_speeds(
        self, coordinates: NamedValues, velocities: NamedValues
    ) -> dict[str, float]:
        """Return the velocities themselves."""
        return {axis: velocities[axis] for axis in self.axes}

    def compute_coordinate_speeds(self, speeds: NamedValues) -> dict[str, float]:
        """Return the speeds themselves."""
        return {axis: speeds.get(axis, 0.0) for axis in self.axes}


def find_axis_bounds(robot: Robot) -> dict[str, CoordinateBounds]:
    """Return the bounds that devices apply to each axis, even if the robot file declares none."""
    limits = SetpointLimits.of(robot)
    rows = zip(limits.low, limits.high, limits.speed, limits.acceleration, strict=True)
    return {
        axis: CoordinateBounds(*map(float, row)) for axis, row in zip(robot.axes, rows, strict=True)
    }


def check_positions_known(axes: tuple[str, ...], joints: NamedValues) -> None:
    """Refuse to begin a mode if the position of an axis is not known.

    Raises
    ------
    FrameError
        If positions are missing. The message names their axes.
    """
    missing = [axis for axis in axes if axis not in joints]
    if missing:
        raise FrameError(
            "mode: the position of axis {names} is not known; connect and home first",
            names=join_messages(map(AxisName, missing), ", "),
        )
