"""Parameters stored in a device, beside those of the robot file."""

from dataclasses import dataclass

from rotemina.sim.messages import message


@dataclass(frozen=True, slots=True)
class ParameterDifference:
    """One parameter that is not as the robot file says.

    ``index`` is the device's own number of it; values are in ``unit``.
    """

    index: int
    name: str
    unit: str
    device: float
    robot: float

    def __str__(self) -> str:
        return message("engine", "{name}: {device} {unit}, robot file {robot} {unit}").fill(
            name=self.name, device=self.device, unit=self.unit, robot=self.robot
        )
