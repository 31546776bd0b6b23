"""Parameters that a board stores: eight 32-bit integers for each axis."""

from binascii import crc_hqx
from collections.abc import Sequence
from typing import NamedTuple

from rotemina.drivers.abilities import VOLTAGE_SLEW_RANGES_PER_S
from rotemina.drivers.mc68hc11.protocol.axes import BoardAxis
from rotemina.sim.messages import marked, message
from rotemina.sim.robot import (
    PiezoAxis,
    Robot,
    StepperAxis,
)

PARAMETERS_PER_AXIS = 8
_CRC_INITIAL = 0xFFFF
# If the robot file has no limits for an axis, it crosses its range in the first time, and
# accelerates to that speed in the second time.
_DEFAULT_CROSSING_S, _DEFAULT_ACCELERATION_S = 1.0, 0.1
# Speed towards the limit switch, as a fraction of the maximum speed.
_HOMING_SPEED_RATIO = 0.5
# Distance from an end of the range to its limit switch, as a fraction of the range.
_OVERTRAVEL_RATIO = 0.01
# Converter codes from 0 to this one cover the voltage range of the amplifier.
MAX_CONVERTER_CODE = 0xFFFF


class ParameterMeaning(NamedTuple):
    """Name of a parameter for the user, and its unit."""

    name: str
    unit: str


_COMMON_PARAMETERS = (
    ParameterMeaning(marked("engine", "low limit"), "steps"),
    ParameterMeaning(marked("engine", "high limit"), "steps"),
    ParameterMeaning(marked("engine", "greatest speed"), "steps/s"),
    ParameterMeaning(marked("engine", "greatest acceleration"), "steps/s/ms"),
)
_STEPPER_PARAMETERS = (
    *_COMMON_PARAMETERS,
    ParameterMeaning(marked("engine", "microsteps per revolution"), ""),
    ParameterMeaning("pitch", "nm"),
    ParameterMeaning(marked("engine", "homing speed"), "steps/s"),
    ParameterMeaning(marked("engine", "distance from the low switch to zero"), "steps"),
)
_PIEZO_PARAMETERS = (
    *_COMMON_PARAMETERS,
    ParameterMeaning(marked("engine", "voltage at code 0"), "mV"),
    ParameterMeaning(marked("engine", "voltage at the last code"), "mV"),
    ParameterMeaning(marked("engine", "greatest slew rate of the converter"), "codes/s"),
    ParameterMeaning("gain", "millisteps/V"),
)


def describe_parameter(robot: Robot, axes: Sequence[BoardAxis], index: int) -> ParameterMeaning:
    """Return the name of a board's parameter, including its axis, and its unit."""
    axis = axes[index // PARAMETERS_PER_AXIS]
    table = (
        _STEPPER_PARAMETERS if isinstance(robot.axes[axis.name], StepperAxis) else _PIEZO_PARAMETERS
    )
    name, unit = table[index % PARAMETERS_PER_AXIS]
    return ParameterMeaning(
        message("engine", "{axis}: {parameter}").fill(axis=axis.name, parameter=name), unit
    )


def make_parameters(robot: Robot, axes: Sequence[BoardAxis]) -> tuple[int, ...]:
    """Return the parameters that a board with these axes of a robot should have."""
    return tuple(number for axis in axes for number in _make_axis_parameters(robot, axis))


def compute_fingerprint(values: Sequence[int]) -> int:
    """Return the CRC over all parameters, which a board reports in its `BoardIdentity`."""
    return crc_hqx(
        b"".join(value.to_bytes(4, "big", signed=True) for value in values), _CRC_INITIAL
    )


def _make_axis_parameters(robot: Robot, board_axis: BoardAxis) -> tuple[int, ...]:
    axis = robot.axes[board_axis.name]
    low, high = axis.range
    speed = axis.max_speed or axis.span / _DEFAULT_CROSSING_S
    acceleration = axis.max_acceleration or speed / _DEFAULT_ACCELERATION_S
    common_values = (
        *board_axis.to_step_range(low, high),
        board_axis.to_steps(speed),
        board_axis.to_steps(1e-3 * acceleration),
    )
    if isinstance(axis, StepperAxis):
        return (
            *common_values,
            (axis.steps_per_rev or 0) * (axis.microsteps_per_step or 1),
            round((axis.pitch or 0.0) * 1e9),
            board_axis.to_steps(_HOMING_SPEED_RATIO * speed),
            board_axis.to_steps(_OVERTRAVEL_RATIO * axis.span),
        )
    assert isinstance(axis, PiezoAxis), "boards move only steppers and piezos"
    first_v, last_v = axis.voltage_range or (low / axis.gain, high / axis.gain)
    assert axis.controller is None or axis.voltage_range is not None
    return (
        *common_values,
        round(1e3 * first_v),
        round(1e3 * last_v),
        round(VOLTAGE_SLEW_RANGES_PER_S * MAX_CONVERTER_CODE),
        round(1e3 * axis.gain / board_axis.step_size),
    )
