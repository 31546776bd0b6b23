"""Parameters that a device keeps, beside those of the robot file."""

from dataclasses import dataclass


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
        return f"{self.name}: {self.device:g} {self.unit}, robot file {self.robot:g} {self.unit}"
