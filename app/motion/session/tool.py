"""The tool at the tip, such as an injector or a vacuum."""

from rotemina.app.motion.device import DeviceLink, require_ability
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.drivers.abilities import ToolOutput
from rotemina.drivers.contract import Permit, PermitPurpose
from rotemina.sim.messages import message


class ToolSwitch:
    """A switch for the tool, locked in the same way as motion."""

    def __init__(self, link: DeviceLink, admission: RequestAdmission) -> None:
        self._link = link
        self._admission = admission

    @property
    def is_on(self) -> bool | None:
        """Whether the tool is on; None if the device has no tool."""
        driver = self._link.driver
        return driver.tool_on if isinstance(driver, ToolOutput) else None

    def switch(self, on: bool, *, permit: Permit | None = None) -> None:
        """Switch the tool on or off. Off is also possible in a fault and while a stop is latched.

        Raises
        ------
        RequestRefusedError
            If the device has no tool or is not connected. Switching on is also refused if motion is
            locked.
        """
        permit = self._admission.resolve_permit(permit)
        refusal = message("engine", "driver {name} has no switchable tool")
        require_ability(self._link.driver, ToolOutput, refusal)
        if on:
            self._admission.refuse_if_motion_blocked()
        # A stop since the request cancels switching on, but never switching off.
        self._link.queue_ability_call(
            ToolOutput,
            refusal,
            lambda driver, permit: driver.switch_tool(on, permit=permit),
            permit.with_purpose(PermitPurpose.SERVICE if on else PermitPurpose.ENQUIRY),
        )
