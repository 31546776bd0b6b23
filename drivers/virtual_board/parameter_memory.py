"""The parameters stored in a board, and values derived from them."""

from collections import deque
from collections.abc import Sequence

from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.parameters import CODES, PER_AXIS, fingerprint, parameters_of
from rotemina.sim.robot.model import Robot, StepperAxis

_LOW, _HIGH, _SPEED, _ACCELERATION, _FIFTH, _SIXTH, _SEVENTH, _EIGHTH = range(PER_AXIS)
_MOST = 1 << 23  # steps: what telemetry has room for
_MS = 1e3
_WRITE_S = 4 * 10e-3  # four bytes of the EEPROM, 10 ms each


class ParameterMemory:
    """Eight whole numbers of each axis of a board; they outlive its resets once they are written.

    A value holds at once, and goes into the EEPROM in the background.
    """

    def __init__(self, robot: Robot, axes: Sequence[BoardAxis]) -> None:
        self._values = list(parameters_of(robot, axes))
        self._written = list(self._values)
        self._waiting: deque[tuple[float, int, int]] = deque()  # written at, index, value
        self._stepper = [isinstance(robot.axes[axis.name], StepperAxis) for axis in axes]

    def __len__(self) -> int:
        return len(self._values)

    def __getitem__(self, index: int) -> int:
        return self._values[index]

    @property
    def fingerprint(self) -> int:
        """The check over all values."""
        return fingerprint(self._values)

    def accepts(self, index: int, value: int) -> bool:
        """Return whether a parameter may have this value beside the others."""
        axis, which = divmod(index, PER_AXIS)
        own = self._values[axis * PER_AXIS : (axis + 1) * PER_AXIS]
        own[which] = value
        if which in (_LOW, _HIGH):
            return -_MOST <= own[_LOW] <= own[_HIGH] < _MOST
        if self._stepper[axis]:
            return value > 0 or (which in (_FIFTH, _SIXTH, _EIGHTH) and value == 0)
        if which in (_FIFTH, _SIXTH):
            return own[_FIFTH] < own[_SIXTH]
        return value != 0 if which == _EIGHTH else value > 0

    def write(self, index: int, value: int, now_s: float = 0.0) -> None:
        """Take a value that is accepted, and begin to write it once those before are written."""
        self._values[index] = value
        begin_s = max(now_s, self._waiting[-1][0]) if self._waiting else now_s
        self._waiting.append((begin_s + _WRITE_S, index, value))

    def writing(self, now_s: float) -> bool:
        """Whether values have yet to be written."""
        while self._waiting and self._waiting[0][0] <= now_s:
            _, index, value = self._waiting.popleft()
            self._written[index] = value
        return bool(self._waiting)

    def recall(self, now_s: float) -> None:
        """Have what is written, as after power came: what was still to be written is lost."""
        self.writing(now_s)
        self._waiting.clear()
        self._values[:] = self._written

    def limits(self, axis: int) -> tuple[int, int]:
        """Return the low and the high limit of an axis, steps."""
        return self._of(axis, _LOW), self._of(axis, _HIGH)

    def inside(self, axis: int, position: float) -> bool:
        """Return whether a position, steps, is within the limits of an axis."""
        low, high = self.limits(axis)
        return low <= position <= high

    def speed(self, axis: int) -> float:
        """Return the greatest speed of an axis, steps/s."""
        return float(max(self._of(axis, _SPEED), 1))

    def acceleration(self, axis: int) -> float:
        """Return the greatest acceleration of an axis, steps/s²."""
        return _MS * max(self._of(axis, _ACCELERATION), 1)

    def homing_speed(self, axis: int) -> float:
        """Return how fast a stepper looks for its switch, steps/s."""
        return min(float(max(self._of(axis, _SEVENTH), 1)), self.speed(axis))

    def way_to_zero(self, axis: int) -> int:
        """Return how far below zero a stepper's low switch is, steps."""
        return self._of(axis, _EIGHTH)

    def at_voltage(self, axis: int, voltage: float) -> float:
        """Return where a piezo goes at a voltage, V, in steps."""
        return 1e-3 * self._of(axis, _EIGHTH) * voltage

    def voltage(self, axis: int, code: float) -> float:
        """Return what the converter puts out at a code, V."""
        first, last = self._of(axis, _FIFTH), self._of(axis, _SIXTH)
        return 1e-3 * (first + (last - first) * code / CODES)

    def rest(self, axis: int) -> float:
        """Return where a piezo without voltage is, or as near to it as the converter comes."""
        first, last = self.voltage(axis, 0), self.voltage(axis, CODES)
        low, high = self.limits(axis)
        return min(max(self.at_voltage(axis, min(max(0.0, first), last)), low), high)

    def slew(self, axis: int) -> float:
        """Return how fast a piezo's converter may change, in steps/s."""
        codes_per_s = self._of(axis, _SEVENTH)
        span = self.voltage(axis, codes_per_s) - self.voltage(axis, 0)
        return abs(self.at_voltage(axis, span))

    def _of(self, axis: int, which: int) -> int:
        return self._values[axis * PER_AXIS + which]
