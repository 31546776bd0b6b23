"""The front panel of the simulated machine: its display, and a manual joystick."""

from abc import ABC
from collections.abc import Mapping, Sequence

from rotemina.drivers.abilities import (
    DISPLAY_COLUMNS,
    DISPLAY_ROWS,
    AnalogInputs,
    Display,
)
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import LimitError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

_BLANK = " " * DISPLAY_COLUMNS


class FrontPanel(Display, AnalogInputs, ABC):
    """A display whose text can be read, and inputs that tests and demonstrations set."""

    def __init__(
        self, robot: Robot, settings: Mapping[str, object] | None = None, *, clock: Clock
    ) -> None:
        super().__init__(robot, settings, clock=clock)
        self._shown = (_BLANK,) * DISPLAY_ROWS
        # One tuple, exchanged as a whole: another thread reads all of it before or after a change.
        self._inputs: tuple[tuple[float, ...], tuple[bool, ...]] = ((), ())

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
