"""Front panel of the simulated machine: a display, a joystick set by the program, and a tool."""

from abc import ABC
from collections.abc import Sequence

from rotemina.drivers.abilities import (
    DISPLAY_COLUMNS,
    DISPLAY_ROWS,
    AnalogInputs,
    TextDisplay,
    ToolOutput,
)
from rotemina.drivers.contract import LimitError, Permit


class FrontPanel(TextDisplay, AnalogInputs, ToolOutput, ABC):
    """Front panel with a display that can be read, inputs that can be set, and a dummy tool."""

    _tool_on = False
    _display_rows = (" " * DISPLAY_COLUMNS,) * DISPLAY_ROWS
    # The tuple is replaced as a whole, so that another thread never reads a partial change.
    _inputs: tuple[tuple[float, ...], tuple[bool, ...]] = ((), ())

    @property
    def tool_on(self) -> bool:
        """Whether the tool is on."""
        return self._tool_on

    def _switch_tool(self, on: bool, permit: Permit) -> None:
        with permit.passing():
            self._tool_on = on

    @property
    def display_rows(self) -> tuple[str, ...]:
        """Rows of the display, each padded to the full width."""
        return self._display_rows

    def _show(self, row: int, text: str) -> None:
        self._display_rows = (*self._display_rows[:row], text, *self._display_rows[row + 1 :])

    def analog_inputs(self) -> tuple[tuple[float, ...], tuple[bool, ...]]:
        """Return the readings, 0 to 1, and whether each button is pressed; empty until set."""
        return self._inputs

    def set_analog_inputs(self, readings: Sequence[float], buttons: Sequence[bool]) -> None:
        """Set the readings of the potentiometers, 0 to 1, and the pressed buttons.

        Raises
        ------
        LimitError
            If a reading is outside 0 to 1; then nothing changes.
        """
        for reading in readings:
            if not 0.0 <= reading <= 1.0:
                raise LimitError(
                    "{name}: potentiometer reading {reading}: must be 0 to 1",
                    name=self.name,
                    reading=reading,
                )
        self._inputs = (tuple(readings), tuple(buttons))
