"""The axes of a robot as its boards count them: three on each, in whole steps.

A step is the resolution of a stepper's measuring system. A piezo's command strays much farther from
its reading, by its hysteresis, and has 16 bits: its step is the next of 1, 2, 5 · 10^n from its
range over 2^16 on, or the sensor's resolution where that is finer still.
"""

from dataclasses import dataclass
from math import ceil, floor, log10
from typing import Self

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11.board_messages import AxisDescription
from rotemina.drivers.mc68hc11.protocol_codes import AXES, Kind, Unit
from rotemina.drivers.mc68hc11.protocol_codes import Role as RoleCode
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import PiezoAxis, Robot, StepperAxis
from rotemina.sim.trajectory.axis_limits import resolution_of

_MOST_MANTISSA = 0xFFFF
_DEVIATIONS = 1 << 16  # steps
_ATOM = 1e-6  # of a step, that division rounds by


@dataclass(frozen=True, slots=True)
class BoardAxis:
    """One axis of a board.

    ``name`` is the robot's, ``number`` the board's own, 0 to 2; a step is
    ``mantissa · 10^exponent`` m or rad.
    """

    name: str
    number: int
    mantissa: int
    exponent: int

    @classmethod
    def of(cls, robot: Robot, name: str, number: int) -> Self:
        """Return an axis as a board for this robot has it.

        Raises
        ------
        InputError
            If no board can move an axis of this kind.
        """
        axis = robot.axes[name]
        if not isinstance(axis, StepperAxis | PiezoAxis):
            raise InputError(
                message(
                    "engine",
                    "robot {robot}: axis {axis} is moved by a {kind}; the MC68HC11 boards move "
                    "stepping motors and piezos",
                ).fill(robot=repr(robot.name), axis=name, kind=axis.kind)
            )
        return cls(name, number, *_step(axis))

    @property
    def step(self) -> float:
        """One step, m or rad."""
        if self.exponent < 0:
            return self.mantissa / 10.0**-self.exponent
        return self.mantissa * 10.0**self.exponent

    def steps(self, value: float) -> int:
        """Return a length, angle or speed in whole steps, the nearest."""
        return round(value / self.step)

    def ends(self, low: float, high: float) -> tuple[int, int]:
        """Return the first and the last whole step inside a range."""
        return ceil(low / self.step - _ATOM), floor(high / self.step + _ATOM)

    def value(self, steps: int) -> float:
        """Return steps as m or rad, the same number for the same steps always."""
        if self.exponent < 0:
            return steps * self.mantissa / 10.0**-self.exponent
        return steps * self.mantissa * 10.0**self.exponent

    def described(self, robot: Robot) -> AxisDescription:
        """Return what the board says of it."""
        axis = robot.axes[self.name]
        stage = next((stage for stage, axes in robot.stages.items() if self.name in axes), "micro")
        low, high = self.ends(*axis.range)
        return AxisDescription(
            axis=self.number,
            kind=Kind.STEPPER if isinstance(axis, StepperAxis) else Kind.PIEZO,
            role=RoleCode.NANO if stage == "nano" else RoleCode.MICRO,
            unit=Unit.RAD if robot.unit(self.name) == "rad" else Unit.M,
            mantissa=self.mantissa,
            exponent=self.exponent,
            low=low,
            high=high,
        )


def board_axes(robot: Robot) -> tuple[tuple[BoardAxis, ...], ...]:
    """Return the axes of each board, the first board's first.

    Raises
    ------
    InputError
        If no board can move one of them, or they are more than two boards have.
    """
    names = tuple(robot.axes)
    if len(names) > 2 * AXES:
        raise InputError(
            message("engine", "robot {name}: {count} axes: two boards have {axes} at most").fill(
                name=repr(robot.name), count=len(names), axes=2 * AXES
            )
        )
    return tuple(
        tuple(
            BoardAxis.of(robot, name, number)
            for number, name in enumerate(names[begin : begin + AXES])
        )
        for begin in range(0, len(names), AXES)
    )


def _step(axis: StepperAxis | PiezoAxis) -> tuple[int, int]:
    """Return mantissa and exponent of an axis' step."""
    resolution = resolution_of(axis)
    finest = axis.span / _DEVIATIONS
    if isinstance(axis, StepperAxis) and axis.pitch and axis.steps_per_rev:
        finest = axis.pitch / (axis.steps_per_rev * (axis.microsteps_per_step or 1))
    if 0.0 < resolution <= finest or (isinstance(axis, StepperAxis) and resolution):
        return _parts(resolution)
    exponent = floor(log10(finest))
    leading = next(one for one in (1, 2, 5, 10) if one * 10.0**exponent >= finest * (1.0 - 1e-9))
    return (leading, exponent) if leading < 10 else (1, exponent + 1)


def _parts(size: float) -> tuple[int, int]:
    """Return a number as a mantissa of 16 bits and a power of ten, rounded if it must be."""
    exponent = floor(log10(size)) - 4
    mantissa = round(size / 10.0**exponent)
    while mantissa % 10 == 0 or mantissa > _MOST_MANTISSA:
        mantissa, exponent = round(mantissa / 10), exponent + 1
    if not -128 <= exponent <= 127:
        raise ProtocolError(
            message("engine", "a step of {size}: its power of ten takes more than 8 bits").fill(
                size=size
            )
        )
    return mantissa, exponent
