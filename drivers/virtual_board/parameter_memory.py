"""Parameters that a board stores, and values derived from them."""

from collections import deque
from collections.abc import Sequence

from rotemina.drivers.mc68hc11.protocol import (
    MAX_CONVERTER_CODE,
    PARAMETERS_PER_AXIS,
    BoardAxis,
    compute_fingerprint,
    make_parameters,
)
from rotemina.sim.robot import Robot, StepperAxis

(
    _LOW_INDEX,
    _HIGH_INDEX,
    _SPEED_INDEX,
    _ACCELERATION_INDEX,
    # The meanings of the last four depend on the actuator.
    _FIFTH_INDEX,
    _SIXTH_INDEX,
    _SEVENTH_INDEX,
    _EIGHTH_INDEX,
) = range(PARAMETERS_PER_AXIS)
# A reading in telemetry has 24 bits.
_MAX_LIMIT_STEPS = 1 << 23
_MS_PER_S = 1e3
# A value has four bytes, and the EEPROM takes 10 ms to write a byte.
_EEPROM_WRITE_S = 4 * 10e-3


class ParameterMemory:
    """Memory for eight integer parameters of each axis of a board.

    A new value takes effect at once and is written to the EEPROM in the background. After a reset
    only the written values remain.
    """

    def __init__(self, robot: Robot, axes: Sequence[BoardAxis]) -> None:
        self._values = list(make_parameters(robot, axes))
        self._stored_values = list(self._values)
        # (completion time, s, index, value) of each write.
        self._pending_writes: deque[tuple[float, int, int]] = deque()
        self._is_stepper = [isinstance(robot.axes[axis.name], StepperAxis) for axis in axes]

    def __len__(self) -> int:
        return len(self._values)

    def __getitem__(self, index: int) -> int:
        return self._values[index]

    @property
    def fingerprint(self) -> int:
        """CRC over all values."""
        return compute_fingerprint(self._values)

    def is_acceptable(self, index: int, value: int) -> bool:
        """Return whether a parameter may have this value, given the other parameters."""
        axis, parameter_index = divmod(index, PARAMETERS_PER_AXIS)
        values = self._values[axis * PARAMETERS_PER_AXIS : (axis + 1) * PARAMETERS_PER_AXIS]
        values[parameter_index] = value
        if parameter_index in (_LOW_INDEX, _HIGH_INDEX):
            return -_MAX_LIMIT_STEPS <= values[_LOW_INDEX] <= values[_HIGH_INDEX] < _MAX_LIMIT_STEPS
        if self._is_stepper[axis]:
            return value > 0 or (
                parameter_index in (_FIFTH_INDEX, _SIXTH_INDEX, _EIGHTH_INDEX) and value == 0
            )
        if parameter_index in (_FIFTH_INDEX, _SIXTH_INDEX):
            return values[_FIFTH_INDEX] < values[_SIXTH_INDEX]
        return value != 0 if parameter_index == _EIGHTH_INDEX else value > 0

    def write(self, index: int, value: int, now_s: float = 0.0) -> None:
        """Set an acceptable value, and write it to the EEPROM after all earlier values."""
        self._values[index] = value
        begin_s = max(now_s, self._pending_writes[-1][0]) if self._pending_writes else now_s
        self._pending_writes.append((begin_s + _EEPROM_WRITE_S, index, value))

    def is_writing(self, now_s: float) -> bool:
        """Return whether values are still being written to the EEPROM."""
        while self._pending_writes and self._pending_writes[0][0] <= now_s:
            _, index, value = self._pending_writes.popleft()
            self._stored_values[index] = value
        return bool(self._pending_writes)

    def recall(self, now_s: float) -> None:
        """Restore the values in the EEPROM, as at power-up. Values not written yet are lost."""
        self.is_writing(now_s)
        self._pending_writes.clear()
        self._values[:] = self._stored_values

    def get_limits(self, axis: int) -> tuple[int, int]:
        """Return the low and the high limit of an axis, steps."""
        return self._get_value(axis, _LOW_INDEX), self._get_value(axis, _HIGH_INDEX)

    def is_inside(self, axis: int, position: float) -> bool:
        """Return whether a position, steps, is within the limits of an axis."""
        low, high = self.get_limits(axis)
        return low <= position <= high

    def get_max_speed(self, axis: int) -> float:
        """Return the maximum speed of an axis, steps/s."""
        return float(max(self._get_value(axis, _SPEED_INDEX), 1))

    def get_max_acceleration(self, axis: int) -> float:
        """Return the maximum acceleration of an axis, steps/s²."""
        return _MS_PER_S * max(self._get_value(axis, _ACCELERATION_INDEX), 1)

    def get_homing_speed(self, axis: int) -> float:
        """Return the speed of a stepper towards its limit switch, steps/s."""
        return min(float(max(self._get_value(axis, _SEVENTH_INDEX), 1)), self.get_max_speed(axis))

    def get_zero_distance(self, axis: int) -> int:
        """Return the distance of a stepper from its low switch to zero, steps."""
        return self._get_value(axis, _EIGHTH_INDEX)

    def compute_position(self, axis: int, voltage: float) -> float:
        """Return the position of a piezo at a voltage, V, in steps."""
        return 1e-3 * self._get_value(axis, _EIGHTH_INDEX) * voltage

    def compute_voltage(self, axis: int, code: float) -> float:
        """Return the output of the converter at a code, V."""
        first_mv, last_mv = self._get_value(axis, _FIFTH_INDEX), self._get_value(axis, _SIXTH_INDEX)
        return 1e-3 * (first_mv + (last_mv - first_mv) * code / MAX_CONVERTER_CODE)

    def find_rest_position(self, axis: int) -> float:
        """Return the position of a piezo at the possible voltage nearest to zero, steps."""
        min_v, max_v = self.compute_voltage(axis, 0), self.compute_voltage(axis, MAX_CONVERTER_CODE)
        low, high = self.get_limits(axis)
        return min(max(self.compute_position(axis, min(max(0.0, min_v), max_v)), low), high)

    def compute_slew(self, axis: int) -> float:
        """Return the maximum slew rate of a piezo's converter, in steps/s."""
        codes_per_s = self._get_value(axis, _SEVENTH_INDEX)
        volts_per_s = self.compute_voltage(axis, codes_per_s) - self.compute_voltage(axis, 0)
        return abs(self.compute_position(axis, volts_per_s))

    def _get_value(self, axis: int, parameter_index: int) -> int:
        return self._values[axis * PARAMETERS_PER_AXIS + parameter_index]
