"""The parameters that a board keeps: eight of each axis, whole numbers of 32 bits."""

from binascii import crc_hqx
from collections.abc import Sequence
from typing import NamedTuple

from rotemina.drivers.abilities import VOLTAGE_SLEW
from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.sim.messages import marked, message
from rotemina.sim.robot.model import PiezoAxis, Robot, StepperAxis

PER_AXIS = 8
_START = 0xFFFF  # of the check, as of a frame's
_CROSSING_S, _STARTING_S = 1.0, 0.1  # an axis that declares no bounds: its range, and to that speed
_HOMING = 0.5  # of the greatest speed, towards the switch
_OVERTRAVEL = 0.01  # of the range: how far beyond its ends the limit switches are
CODES = 0xFFFF  # of the converter, over the amplifier's voltage range


class Meaning(NamedTuple):
    """What a parameter says, and in which unit."""

    name: str
    unit: str


_OF_ALL = (
    Meaning(marked("engine", "low limit"), "steps"),
    Meaning(marked("engine", "high limit"), "steps"),
    Meaning(marked("engine", "greatest speed"), "steps/s"),
    Meaning(marked("engine", "greatest acceleration"), "steps/s/ms"),
)
_OF_STEPPERS = (
    *_OF_ALL,
    Meaning(marked("engine", "microsteps a revolution"), ""),
    Meaning("pitch", "nm"),
    Meaning(marked("engine", "homing speed"), "steps/s"),
    Meaning(marked("engine", "distance from the low switch to zero"), "steps"),
)
_OF_PIEZOS = (
    *_OF_ALL,
    Meaning(marked("engine", "voltage at code 0"), "mV"),
    Meaning(marked("engine", "voltage at the last code"), "mV"),
    Meaning(marked("engine", "greatest slew of the converter"), "codes/s"),
    Meaning("gain", "millisteps/V"),
)


def meaning(robot: Robot, axes: Sequence[BoardAxis], index: int) -> Meaning:
    """Return what a board's parameter of this number says, with the axis' name before it."""
    axis = axes[index // PER_AXIS]
    table = _OF_STEPPERS if isinstance(robot.axes[axis.name], StepperAxis) else _OF_PIEZOS
    name, unit = table[index % PER_AXIS]
    return Meaning(
        message("engine", "{axis}: {parameter}").fill(axis=axis.name, parameter=name), unit
    )


def parameters_of(robot: Robot, axes: Sequence[BoardAxis]) -> tuple[int, ...]:
    """Return the parameters that a board with these axes of a robot should have."""
    return tuple(number for axis in axes for number in _of(robot, axis))


def fingerprint(values: Sequence[int]) -> int:
    """Return the check over all parameters, as a board announces it (`Identity`)."""
    return crc_hqx(b"".join(value.to_bytes(4, "big", signed=True) for value in values), _START)


def _of(robot: Robot, own: BoardAxis) -> tuple[int, ...]:
    axis = robot.axes[own.name]
    low, high = axis.range
    speed = axis.max_speed or axis.span / _CROSSING_S
    acceleration = axis.max_acceleration or speed / _STARTING_S
    shared = (*own.ends(low, high), own.steps(speed), own.steps(1e-3 * acceleration))
    if isinstance(axis, StepperAxis):
        return (
            *shared,
            (axis.steps_per_rev or 0) * (axis.microsteps_per_step or 1),
            round((axis.pitch or 0.0) * 1e9),
            own.steps(_HOMING * speed),
            own.steps(_OVERTRAVEL * axis.span),
        )
    assert isinstance(axis, PiezoAxis), "boards move nothing else"
    first, last = axis.voltage_range or (low / axis.gain, high / axis.gain)
    assert axis.controller is None or axis.voltage_range is not None
    return (
        *shared,
        round(1e3 * first),
        round(1e3 * last),
        round(VOLTAGE_SLEW * CODES),
        round(1e3 * axis.gain / own.step),
    )
