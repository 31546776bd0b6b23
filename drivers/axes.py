"""Descriptions of axes: kind, role, range, unit and resolution."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Self

from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import resolution_of


class Role(StrEnum):
    """The stage that an axis belongs to."""

    MICRO = "micro"
    NANO = "nano"
    NONE = "none"


@dataclass(frozen=True, slots=True)
class AxisDescription:
    """One axis of a device.

    Attributes
    ----------
    name : str
    kind : str
        ``stepper``, ``piezo`` or ``force``.
    role : Role
    low, high : float
        Ends of its range, in ``unit``.
    unit : str
        ``m`` or ``rad``.
    resolution : float
        The smallest step that it can be told or can tell, in ``unit``; 0 if there is none.
    max_speed, max_acceleration : float or None
        The device's own, in ``unit``/s and ``unit``/s²; None where the robot file's hold.
    """

    name: str
    kind: str
    role: Role
    low: float
    high: float
    unit: str
    resolution: float
    max_speed: float | None = None
    max_acceleration: float | None = None

    @classmethod
    def of(cls, robot: Robot, name: str) -> Self:
        """Return the description of an axis from its robot file."""
        axis = robot.axes[name]
        stage = next((stage for stage, axes in robot.stages.items() if name in axes), None)
        role = Role(stage) if stage in tuple(Role) else Role.NONE
        low, high = axis.range
        return cls(name, axis.kind, role, low, high, robot.unit(name) or "", resolution_of(axis))
