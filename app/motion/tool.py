"""The tool at the tip: an injector, a vacuum."""

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.mailbox import able
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.tool import ToolOutput
from rotemina.sim.messages import message


class Tool:
    """A switch, which is locked as motion is."""

    def __init__(self, link: DeviceLink, admission: Admission) -> None:
        self._link = link
        self._admission = admission

    @property
    def on(self) -> bool | None:
        """Whether the tool is on; None where the device has none."""
        driver = self._link.driver
        return driver.tool_on if isinstance(driver, ToolOutput) else None

    def switch(self, on: bool, *, permit: Permit | None = None) -> None:
        """Switch the tool; off is possible in a fault and while a stop is latched too.

        Raises
        ------
        RefusedError
            If the device has none or is not connected; to switch on, if motion is locked.
        """
        permit = self._admission.drawn(permit)
        refusal = message("engine", "driver {name} has no switchable tool")
        able(self._link.driver, ToolOutput, refusal)
        if on:
            self._admission.refuse_if_locked()
        # Switched on, what has come since counts; switched off, nothing does.
        self._link.ask_able(
            ToolOutput,
            refusal,
            lambda driver, permit: driver.switch_tool(on, permit=permit),
            permit.meant_for(Purpose.SERVICE if on else Purpose.ENQUIRY),
        )
