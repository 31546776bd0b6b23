"""The simulated machine's tool, which only remembers its state."""

from abc import ABC
from collections.abc import Mapping

from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.drivers.tool import ToolOutput
from rotemina.sim.robot.model import Robot


class SimulatedTool(ToolOutput, ABC):
    """A tool without an effect on the machine."""

    def __init__(
        self, robot: Robot, settings: Mapping[str, object] | None = None, *, clock: Clock
    ) -> None:
        super().__init__(robot, settings, clock=clock)
        self._tool_on = False

    @property
    def tool_on(self) -> bool:
        """Whether the tool is on."""
        return self._tool_on

    def _switch_tool(self, on: bool, permit: Permit) -> None:
        with permit.passing():
            self._tool_on = on
