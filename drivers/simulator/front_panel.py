"""The front panel of the simulated machine: its display, a manual joystick, and the tool."""

from abc import ABC
from collections.abc import Sequence

from rotemina.drivers.abilities import (
    DISPLAY_COLUMNS,
    DISPLAY_ROWS,
    AnalogInputs,
    Display,
)
from rotemina.drivers.errors import LimitError
from rotemina.drivers.gate import Permit
from rotemina.drivers.tool import ToolOutput
from rotemina.sim.messages import message


class FrontPanel(Display, AnalogInputs, ToolOutput, ABC):
    """A display whose text can be read, inputs that are set, and a tool without an effect."""

    _tool_on = False
    _shown = (" " * DISPLAY_COLUMNS,) * DISPLAY_ROWS
    # One tuple, exchanged as a whole: another thread reads all of it before or after a change.
    _inputs: tuple[tuple[float, ...], tuple[bool, ...]] = ((), ())

    @property
    def tool_on(self) -> bool:
        """Whether the tool is on."""
        return self._tool_on

    def _switch_tool(self, on: bool, permit: Permit) -> None:
        with permit.passing():
            self._tool_on = on

    @property
    def shown(self) -> tuple[str, ...]:
        """The rows of the display, each as long as the display is wide."""
        return self._shown

    def _show(self, row: int, text: str) -> None:
        self._shown = (*self._shown[:row], text, *self._shown[row + 1 :])

    def analog_inputs(self) -> tuple[tuple[float, ...], tuple[bool, ...]]:
        """Return the readings, each 0 to 1, and whether each button is held; none until set."""
        return self._inputs

    def set_analog_inputs(self, readings: Sequence[float], buttons: Sequence[bool]) -> None:
        """Set the potentiometers, 0 to 1, and the held buttons.

        Raises
        ------
        LimitError
            If a reading is none of 0 to 1; then nothing changes.
        """
        for reading in readings:
            if not 0.0 <= reading <= 1.0:
                raise LimitError(
                    message(
                        "engine", "{name}: potentiometer reading {reading}: must be 0 to 1"
                    ).fill(name=self.name, reading=reading)
                )
        self._inputs = (tuple(readings), tuple(buttons))
