"""Optional interface of drivers for devices that store parameters."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import final

from rotemina.drivers.contract import DeviceState, Driver, Permit, PermitPurpose, StateError
from rotemina.sim.messages import message


@dataclass(frozen=True, slots=True)
class ParameterDifference:
    """One parameter whose value in the device differs from the robot file.

    ``index`` is the number of the parameter in the device. ``device`` and ``robot`` are the values
    in the device and in the robot file, in ``unit``.
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


class ParameterStore(Driver, ABC):
    """A device that stores parameters, which may differ from the robot file.

    If they differ, no motion is possible until the operator accepts them.
    """

    @property
    @abstractmethod
    def differences(self) -> tuple[ParameterDifference, ...]:
        """The parameters that differed from the robot file when the device was opened."""

    @final
    def accept_parameters(self) -> None:
        """Allow motion with the device's parameters until the device is opened again."""
        self._require_open("accept its parameters")
        self._accept_parameters()

    @final
    def write_parameters(self, *, permit: Permit | None = None) -> None:
        """Start writing the robot file's parameters to the device, which stores them.

        Raises
        ------
        StateError
            If the device is closed or not at rest.
        """
        permit = self._require_permit(permit, PermitPurpose.SERVICE)
        self._require_open("write its parameters")
        state = self._status().state
        if state not in (DeviceState.IDLE, DeviceState.FAULT):
            raise StateError(
                "{name}: cannot write its parameters while it is {state}",
                name=self.name,
                state=state,
            )
        self._write_parameters(permit)

    @abstractmethod
    def _accept_parameters(self) -> None:
        pass

    @abstractmethod
    def _write_parameters(self, permit: Permit) -> None:
        """Start writing the parameters."""
