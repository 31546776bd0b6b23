"""Description of a device's axes: kind, role, range, unit and resolution."""

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Self

from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import get_command_resolution


class StageRole(StrEnum):
    """The stage to which an axis belongs."""

    MICRO = "micro"
    NANO = "nano"
    NONE = "none"


@dataclass(frozen=True, slots=True)
class DeviceAxis:
    """One axis of a device.

    Attributes
    ----------
    name : str
    kind : str
        ``stepper``, ``piezo``, or ``force`` for a mass that is moved by a force.
    role : StageRole
        The stage to which the axis belongs.
    low, high : float
        Ends of the range, in ``unit``.
    unit : str
        ``m`` or ``rad``; empty if the robot file does not state it.
    resolution : float
        The smallest step of a command or a reading, in ``unit``; 0 if unknown.
    max_speed, max_acceleration : float or None
        Limits of the device, in ``unit``/s and ``unit``/s²; None if the robot file's limits apply.
    """

    name: str
    kind: str
    role: StageRole
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
        role = StageRole(stage) if stage in tuple(StageRole) else StageRole.NONE
        low, high = axis.range
        return cls(
            name, axis.kind, role, low, high, robot.unit(name) or "", get_command_resolution(axis)
        )


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        AxisDescription="DeviceAxis",
        Role="StageRole",
    )
