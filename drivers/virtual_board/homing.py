"""Homing by a board: to the low switch, slowly back, and to zero."""

from enum import Enum, auto

from rotemina.drivers.virtual_board.axis_drive import AxisDrive
from rotemina.drivers.virtual_board.parameter_memory import ParameterMemory

_SLOWLY = 0.1  # of the homing speed, away from the switch


class _Phase(Enum):
    SEEK = auto()  # towards the switch
    HALT = auto()  # beyond it
    BACK = auto()  # until it opens
    ZERO = auto()  # on the way to zero


class HomingAxis:
    """One stepper during homing; ``step`` follows its switch."""

    def __init__(self, axis: int, drive: AxisDrive, kept: ParameterMemory) -> None:
        self.axis = axis
        self._drive = drive
        self._kept = kept
        self._phase = _Phase.SEEK
        drive.unbound()
        drive.drive(-kept.homing_speed(axis))

    def step(self, closed: bool) -> bool:
        """Advance; ``closed`` is the low switch. Return whether it has just opened."""
        if self._phase is _Phase.SEEK and closed:
            self._drive.halt()
            self._phase = _Phase.HALT
        elif self._phase is _Phase.HALT and not self._drive.moving:
            self._drive.drive(_SLOWLY * self._kept.homing_speed(self.axis))
            self._phase = _Phase.BACK
        elif self._phase is _Phase.BACK and not closed:
            self._phase = _Phase.ZERO
            return True
        return False

    def count(self) -> None:
        """Count from the switch, and go to zero."""
        self._drive.shift(-self._kept.way_to_zero(self.axis))
        low, high = self._kept.limits(self.axis)
        self._drive.move_to(min(max(0, low), high), self._kept.homing_speed(self.axis))

    @property
    def done(self) -> bool:
        """Whether it is at zero."""
        return self._phase is _Phase.ZERO and not self._drive.moving
