"""Axes of a robot in board units: up to three axes on each board, with positions in whole steps.

The step of a stepper is the resolution of its measuring system. Because of hysteresis, the command
of a piezo differs much more from its reading, and telemetry has only 16 bits for this difference.
So the step of a piezo is its range divided by 2^16, rounded up to 1, 2 or 5 · 10^n. If the
resolution of its sensor is finer than the range divided by 2^16, that resolution is the step.
"""

from dataclasses import dataclass
from math import ceil, floor, log10
from typing import Self

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol.board_messages import AxisDescription
from rotemina.drivers.mc68hc11.protocol.protocol_codes import (
    AXES_PER_BOARD,
    ActuatorKind,
    StageCode,
    StepUnit,
)
from rotemina.sim.errors import InputError
from rotemina.sim.robot import (
    PiezoAxis,
    Robot,
    StepperAxis,
)
from rotemina.sim.trajectory import get_command_resolution

_MAX_MANTISSA = 0xFFFF
# Telemetry can report this many different deviations of a command from its reading.
_DEVIATION_STEPS = 1 << 16
# Rounding error of a division, as a fraction of a step.
_STEP_ROUNDING = 1e-6


@dataclass(frozen=True, slots=True)
class BoardAxis:
    """Axis of a board.

    ``name`` is the name in the robot file, and ``number`` is the number on the board, 0 to 2. The
    step size is ``mantissa · 10^exponent`` m or rad.
    """

    name: str
    number: int
    mantissa: int
    exponent: int

    @classmethod
    def from_robot(cls, robot: Robot, name: str, number: int) -> Self:
        """Return the axis of a board that belongs to an axis of a robot.

        Raises
        ------
        InputError
            If no board can move an axis of this kind.
        """
        axis = robot.axes[name]
        if not isinstance(axis, StepperAxis | PiezoAxis):
            raise InputError(
                "robot {robot}: axis {axis} is moved by a {kind}; the MC68HC11 boards move "
                "stepping motors and piezos",
                robot=repr(robot.name),
                axis=name,
                kind=axis.kind,
            )
        return cls(name, number, *_choose_step(axis))

    @property
    def step_size(self) -> float:
        """Size of one step, m or rad."""
        if self.exponent < 0:
            return self.mantissa / 10.0**-self.exponent
        return self.mantissa * 10.0**self.exponent

    def to_steps(self, value: float) -> int:
        """Convert a position or speed in SI units to whole steps, rounded to the nearest."""
        return round(value / self.step_size)

    def to_step_range(self, low: float, high: float) -> tuple[int, int]:
        """Return the first and the last whole step inside a range."""
        return ceil(low / self.step_size - _STEP_ROUNDING), floor(
            high / self.step_size + _STEP_ROUNDING
        )

    def to_si(self, steps: int) -> float:
        """Convert steps to m or rad. Equal steps always give exactly the same number."""
        if self.exponent < 0:
            return steps * self.mantissa / 10.0**-self.exponent
        return steps * self.mantissa * 10.0**self.exponent

    def describe(self, robot: Robot) -> AxisDescription:
        """Return the description of the axis that a board of this robot sends."""
        axis = robot.axes[self.name]
        stage = next((stage for stage, axes in robot.stages.items() if self.name in axes), "micro")
        low, high = self.to_step_range(*axis.range)
        return AxisDescription(
            axis=self.number,
            kind=ActuatorKind.STEPPER if isinstance(axis, StepperAxis) else ActuatorKind.PIEZO,
            role=StageCode.NANO if stage == "nano" else StageCode.MICRO,
            unit=StepUnit.RAD if robot.unit(self.name) == "rad" else StepUnit.M,
            mantissa=self.mantissa,
            exponent=self.exponent,
            low=low,
            high=high,
        )


def make_board_axes(robot: Robot) -> tuple[tuple[BoardAxis, ...], ...]:
    """Return the axes of each board, those of the first board first.

    Raises
    ------
    InputError
        If no board can move one of the axes, or the robot has more axes than two boards.
    """
    names = tuple(robot.axes)
    if len(names) > 2 * AXES_PER_BOARD:
        raise InputError(
            "robot {name}: {count} axes: two boards have {axes} at most",
            name=repr(robot.name),
            count=len(names),
            axes=2 * AXES_PER_BOARD,
        )
    return tuple(
        tuple(
            BoardAxis.from_robot(robot, name, number)
            for number, name in enumerate(names[first : first + AXES_PER_BOARD])
        )
        for first in range(0, len(names), AXES_PER_BOARD)
    )


def _choose_step(axis: StepperAxis | PiezoAxis) -> tuple[int, int]:
    """Return the mantissa and the exponent of the step size of an axis."""
    resolution = get_command_resolution(axis)
    min_step = axis.span / _DEVIATION_STEPS
    if isinstance(axis, StepperAxis) and axis.pitch and axis.steps_per_rev:
        min_step = axis.pitch / (axis.steps_per_rev * (axis.microsteps_per_step or 1))
    if 0.0 < resolution <= min_step or (isinstance(axis, StepperAxis) and resolution):
        return _split_decimal(resolution)
    exponent = floor(log10(min_step))
    leading_digit = next(
        digit for digit in (1, 2, 5, 10) if digit * 10.0**exponent >= min_step * (1.0 - 1e-9)
    )
    return (leading_digit, exponent) if leading_digit < 10 else (1, exponent + 1)


def _split_decimal(size: float) -> tuple[int, int]:
    """Return the 16-bit mantissa, rounded, and the decimal exponent of a step size."""
    exponent = floor(log10(size)) - 4
    mantissa = round(size / 10.0**exponent)
    while mantissa % 10 == 0 or mantissa > _MAX_MANTISSA:
        mantissa, exponent = round(mantissa / 10), exponent + 1
    if not -128 <= exponent <= 127:
        raise ProtocolError("a step of {size}: its power of ten takes more than 8 bits", size=size)
    return mantissa, exponent
