"""Homing by a board: an axis moves to its low switch, slowly off the switch, and to zero."""

from enum import Enum, auto

from rotemina.drivers.virtual_board.axis_drive import AxisDrive
from rotemina.drivers.virtual_board.parameter_memory import ParameterMemory

# Speed away from the switch, as a fraction of the homing speed.
_RETURN_SPEED_RATIO = 0.1


class _Phase(Enum):
    # Moving to the switch.
    SEEK = auto()
    # Braking after the switch has closed.
    HALT = auto()
    # Moving slowly off the switch until it opens.
    BACK = auto()
    # Moving to zero.
    ZERO = auto()


class HomingAxis:
    """Stepper axis during homing."""

    def __init__(self, axis: int, drive: AxisDrive, parameters: ParameterMemory) -> None:
        self.axis = axis
        self._drive = drive
        self._parameters = parameters
        self._phase = _Phase.SEEK
        drive.remove_limits()
        drive.drive(-parameters.get_homing_speed(axis))

    def follow_switch(self, is_closed: bool) -> bool:
        """React to the state of the low switch. Return whether the axis has just left it."""
        if self._phase is _Phase.SEEK and is_closed:
            self._drive.halt()
            self._phase = _Phase.HALT
        elif self._phase is _Phase.HALT and not self._drive.moving:
            self._drive.drive(_RETURN_SPEED_RATIO * self._parameters.get_homing_speed(self.axis))
            self._phase = _Phase.BACK
        elif self._phase is _Phase.BACK and not is_closed:
            self._phase = _Phase.ZERO
            return True
        return False

    def set_zero(self) -> None:
        """Set the position, which is known at the switch, and start to move to zero."""
        self._drive.shift(-self._parameters.get_zero_distance(self.axis))
        low, high = self._parameters.get_limits(self.axis)
        self._drive.move_to(min(max(0, low), high), self._parameters.get_homing_speed(self.axis))

    @property
    def is_complete(self) -> bool:
        """Whether homing is complete, with the axis at zero."""
        return self._phase is _Phase.ZERO and not self._drive.moving
