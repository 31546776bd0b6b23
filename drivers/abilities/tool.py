"""Devices that switch a tool on and off, such as an injection pump, a valve or a light."""

from abc import ABC, abstractmethod
from typing import final

from rotemina.drivers.contract import Driver, Permit, PermitPurpose


class ToolOutput(Driver, ABC):
    """A device with one output that switches a tool.

    The tool is off after the device is opened and after a stop, so that nothing flows into a cell
    without supervision.
    """

    @property
    @abstractmethod
    def tool_on(self) -> bool:
        """Whether the tool is on; may be read on any thread."""

    @final
    def switch_tool(self, on: bool, *, permit: Permit | None = None) -> None:
        """Switch the tool. It can be switched off while the device is open, even during a fault.

        Raises
        ------
        StateError
            If the device is closed. Switching on is also refused during a fault, while the position
            is unknown, and while the device does not answer.
        """
        # Switching off must always be possible, and neither a stop nor a lock refuses an enquiry.
        purpose = PermitPurpose.SERVICE if on else PermitPurpose.ENQUIRY
        permit = self.gate.permit(purpose) if permit is None else permit.with_purpose(purpose)
        permit.check()
        if on:
            self._require_operational("switch the tool on")
        else:
            self._require_open("switch the tool off")
        self._switch_tool(on, permit)

    @abstractmethod
    def _switch_tool(self, on: bool, permit: Permit) -> None:
        pass
