"""Frames: the mapping of an operator's coordinates to joints, in one mode.

A frame is anchored at the joints where its mode begins: its coordinates there are its ``start``,
and :meth:`Frame.joints` of them are the very joints. So to switch modes moves nothing: begin the
new frame at the present commands, and the laws at its ``start`` with the speed that
:meth:`Frame.velocities` tells.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Self

from rotemina.app.motion.teleoperation.reference import Bounds
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, joined, message
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits

Values = Mapping[str, float]


class FrameError(InputError):
    """A mode that a robot cannot have, or joints that it cannot begin at."""


@dataclass(frozen=True, slots=True)
class Coordinate:
    """One degree of freedom of a mode: its name, m or rad, its bounds, where the mode began."""

    name: str
    unit: str
    bounds: Bounds
    start: float

    @classmethod
    def of(cls, name: str, unit: str, bounds: Bounds, start: float) -> Self:
        """Return a coordinate whose range holds its start, which rounding may put beside it."""
        low, high = min(bounds.low, start), max(bounds.high, start)
        return cls(name, unit, replace(bounds, low=low, high=high), start)


class Frame(ABC):
    """What coordinates mean for joints.

    Attributes
    ----------
    name : str
        Of the mode.
    coordinates : mapping of str to Coordinate
        In the order in which the axes x, y, z of a stick move them, unless a profile says
        otherwise.
    axes : tuple of str
        The robot's axes that the mode moves; the others stay.
    """

    def __init__(
        self, name: str, coordinates: tuple[Coordinate, ...], axes: tuple[str, ...]
    ) -> None:
        self.name = name
        self.coordinates = MappingProxyType({one.name: one for one in coordinates})
        self.axes = axes

    @property
    def start(self) -> dict[str, float]:
        """The coordinates where the mode began."""
        return {name: one.start for name, one in self.coordinates.items()}

    @abstractmethod
    def joints(self, coordinates: Values) -> dict[str, float]:
        """Return where the axes are, m or rad, for all coordinates; inside their ranges."""

    @abstractmethod
    def speeds(self, coordinates: Values, velocities: Values) -> dict[str, float]:
        """Return how fast the axes go where the coordinates change so fast, per s."""

    @abstractmethod
    def velocities(self, speeds: Values) -> dict[str, float]:
        """Return how fast the coordinates change at the start when axes go so fast.

        What the axes do that no coordinate describes is left out; it has to be braked.
        """

    def reserve(self, coordinates: Values) -> float | None:
        """Return how much of its range a piezo still has: 1 in the middle, 0 at an end.

        None where no piezo shares the motion.
        """
        return None

    def tilt(self, coordinates: Values) -> float | None:
        """Return by how much the tool has been turned since the start, rad; None: not by this."""
        return None


class AxesFrame(Frame):
    """Each coordinate is an axis: the frame of one stage.

    Parameters
    ----------
    robot : Robot
    name : str
    axes : tuple of str
    joints : mapping of str to float
        Where the axes are, m or rad.

    Raises
    ------
    FrameError
        If the place of an axis is not known.
    """

    def __init__(self, robot: Robot, name: str, axes: tuple[str, ...], joints: Values) -> None:
        check_known(axes, joints)
        bounds = axis_bounds(robot)
        coordinates = tuple(
            Coordinate(axis, robot.unit(axis) or "m", bounds[axis], bounds[axis].clip(joints[axis]))
            for axis in axes
        )
        super().__init__(name, coordinates, axes)

    def joints(self, coordinates: Values) -> dict[str, float]:
        """Return the coordinates themselves."""
        return {a: self.coordinates[a].bounds.clip(coordinates[a]) for a in self.axes}

    def speeds(self, coordinates: Values, velocities: Values) -> dict[str, float]:
        """Return the velocities themselves."""
        return {axis: velocities[axis] for axis in self.axes}

    def velocities(self, speeds: Values) -> dict[str, float]:
        """Return the speeds themselves."""
        return {axis: speeds.get(axis, 0.0) for axis in self.axes}


def axis_bounds(robot: Robot) -> dict[str, Bounds]:
    """Return the bounds of each axis as the devices keep them, also where none are declared."""
    limits = SetpointLimits.of(robot)
    rows = zip(limits.low, limits.high, limits.speed, limits.acceleration, strict=True)
    return {axis: Bounds(*map(float, row)) for axis, row in zip(robot.axes, rows, strict=True)}


def check_known(axes: tuple[str, ...], joints: Values) -> None:
    """Refuse to begin a mode at joints of which one is not known.

    Raises
    ------
    FrameError
        With the axes that are missing.
    """
    missing = [axis for axis in axes if axis not in joints]
    if missing:
        raise FrameError(
            message(
                "engine", "mode: the position of axis {names} is not known; connect and home first"
            ).fill(names=joined(map(AxisName, missing), ", "))
        )
