"""A switchable tool on a device: an injection pump, a valve, a light."""

from abc import ABC, abstractmethod
from typing import final

from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Permit, Purpose


class ToolOutput(Driver, ABC):
    """A device with one output that switches a tool.

    The tool is off when the device is opened, and after a stop: what nobody watches any more does
    not continue flowing into a cell.
    """

    @property
    @abstractmethod
    def tool_on(self) -> bool:
        """Whether the tool is on; any thread may ask."""

    @final
    def switch_tool(self, on: bool, *, permit: Permit | None = None) -> None:
        """Switch the tool. Off is possible whenever the device is open, in a fault too.

        Raises
        ------
        StateError
            If the device is closed; to switch on, also in a fault, while the position is unknown
            or the device does not answer.
        """
        purpose = Purpose.SERVICE if on else Purpose.ENQUIRY
        permit = self.gate.permit(purpose) if permit is None else permit.meant_for(purpose)
        permit.check()
        if on:
            self._require_sound("switch the tool on")
        else:
            self._require_open("switch the tool off")
        self._switch_tool(on, permit)

    @abstractmethod
    def _switch_tool(self, on: bool, permit: Permit) -> None:
        """Switch the output."""
