"""A robot's axes in a GRBL controller's coordinates: letters, mm or degrees, origin, range.

GRBL counts from minus the travel (``$130`` and on) to 0, whichever end the switch is at. With a
forced origin (GRBL's option Z, bit 3 of ``$22`` in grblHAL) it counts from 0 at the switch, and
FluidNC from a position that its configuration names. The low end of an axis' range lies at the low
end of the travel.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import floor, pi, sqrt
from typing import Self

from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.reading_check import ReadingBounds
from rotemina.sim.errors import InputError
from rotemina.sim.messages import joined, message
from rotemina.sim.quantities import fixed
from rotemina.sim.robot.model import Robot, StepperAxis

_UNITS = {"m": 1000.0, "rad": 180.0 / pi}  # to mm, to degrees
_DIGIT = 1e-3  # a report has three decimals
_FIRST_STEPS, _FIRST_RATE, _FIRST_ACCELERATION, _FIRST_TRAVEL = 100, 110, 120, 130
_PER_MINUTE = 60.0
_SLACK = 1e-6  # settings have three decimals; this is their rounding, as a share
# A report is rounded, and so is the place where a controller ends a move.
_TOLERANCE_STEPS = 2.0


@dataclass(frozen=True, slots=True)
class StageAxis:
    """One axis of a controller.

    Attributes
    ----------
    name : str
        The robot's.
    letter : str
    number : int
        Its place in reports and settings.
    scale : float
        Units of the controller (mm, degrees) in one of the robot (m, rad).
    low, high : float
        Ends of the range, m or rad.
    travel, resolution : float
        What the controller travels, and the smallest step that it reports, m or rad.
    speed, acceleration : float
        The greatest, m/s and m/s² or rad/s and rad/s².
    origin : float
        Where the controller counts the low end of the range, mm or degrees.
    """

    name: str
    letter: str
    number: int
    scale: float
    low: float
    high: float
    travel: float
    resolution: float
    speed: float
    acceleration: float
    origin: float

    @classmethod
    def of(
        cls, robot: Robot, name: str, letter: str, number: int, settings: ControllerSettings
    ) -> Self:
        """Return an axis as the settings of its controller say.

        Raises
        ------
        InputError
            If a setting is missing.
        """
        axis = robot.axes[name]
        scale = _UNITS[robot.unit(name) or "m"]

        def value(first: int) -> float:
            setting = settings.number(first + number)
            if setting is None or setting <= 0.0:
                raise InputError(
                    message(
                        "engine",
                        "axis {name}: the controller has no setting ${first}; it needs one for "
                        "each of the {count} axes",
                    ).fill(name=name, first=first + number, count=len(robot.axes))
                )
            return setting

        travel = value(_FIRST_TRAVEL)
        speed = value(_FIRST_RATE) / _PER_MINUTE / scale
        return cls(
            name,
            letter,
            number,
            scale,
            *axis.range,
            travel / scale,
            max(_DIGIT, 1.0 / value(_FIRST_STEPS)) / scale,
            min(speed, axis.max_speed or speed),
            value(_FIRST_ACCELERATION) / scale,
            settings.declared_low_end(letter, number, travel),
        )

    @property
    def tolerance(self) -> float:
        """By how much a report may differ from where the axis is, m or rad."""
        return _TOLERANCE_STEPS * self.resolution

    @property
    def reading_bounds(self) -> ReadingBounds:
        """What reports of this axis may say."""
        return ReadingBounds(self.low, self.high, self.speed, self.tolerance)

    @property
    def permitted_targets(self) -> tuple[float, float]:
        """Ends of the range in the controller's coordinates."""
        return self.rounded(self.low), self.rounded(self.high)

    def located(self, homed_at: float, settings: ControllerSettings) -> Self:
        """Return the axis with its origin as the controller counts it after homing.

        Raises
        ------
        InputError
            If the count fits no machine space, or the range of the robot file.
        """
        travel = self.travel * self.scale
        origin = settings.low_end_after_homing(self.letter, self.number, travel, homed_at)
        located = self if origin is None else replace(self, origin=origin)
        at = located.value(homed_at)
        if origin is not None and self.low - self.tolerance <= at <= self.high + self.tolerance:
            return located
        unit = "mm" if self.scale == _UNITS["m"] else "deg"
        raise InputError(
            message(
                "engine",
                "axis {name}: after homing the controller counts {count} {unit}, which is not "
                "within its range: the robot file has {low} to {high} {unit}, the controller "
                "travels {travel} {unit} (${setting}). Correct ${setting} and the homing settings "
                "($22, $23, $27), or the robot file",
            ).fill(
                name=self.name,
                count=fixed(homed_at, 3),
                unit=unit,
                low=fixed(self.low * self.scale, 3),
                high=fixed(self.high * self.scale, 3),
                travel=fixed(travel, 3),
                setting=_FIRST_TRAVEL + self.number,
            )
        )

    def rounded(self, value: float) -> float:
        """Return a position, m or rad, in the controller's coordinates, in its own digits."""
        bounded = min(max(value, self.low), self.high)
        return round(self.origin + (bounded - self.low) * self.scale, 3)

    def value(self, number: float) -> float:
        """Return a position of a report in m or rad."""
        return self.low + (number - self.origin) / self.scale


def check_agreement(robot: Robot, axes: Sequence[StageAxis], settings: ControllerSettings) -> None:
    """Refuse a controller whose travel, speed or acceleration does not cover the robot file.

    Raises
    ------
    InputError
        With every difference, and what to send to the controller.
    """
    differences = [
        difference for axis in axes for difference in _differences_of(robot, axis, settings)
    ]
    if differences:
        raise InputError(
            message(
                "engine",
                "the controller's settings do not agree with the robot file: {differences}. Send "
                "them to the controller, or correct the file",
            ).fill(differences=joined(differences, ", "))
        )


def _differences_of(robot: Robot, axis: StageAxis, settings: ControllerSettings) -> list[str]:
    described = robot.axes[axis.name]
    per_minute = _PER_MINUTE * axis.scale
    # Travel and speed must suffice; the acceleration decides how long a stop takes, so it is the
    # same: more could lose steps, less lets the axis run on farther than the file says.
    wanted = {
        _FIRST_TRAVEL: (described.span * axis.scale, False),
        _FIRST_RATE: ((described.max_speed or 0.0) * per_minute, False),
        _FIRST_ACCELERATION: ((described.max_acceleration or 0.0) * axis.scale, True),
    }
    unit = "mm" if axis.scale == _UNITS["m"] else "deg"
    units = {
        _FIRST_TRAVEL: unit,
        _FIRST_RATE: f"{unit}/min",
        _FIRST_ACCELERATION: f"{unit}/s²",
    }
    differences: list[str] = []
    for first, (value, exactly) in wanted.items():
        present = settings.number(first + axis.number) or 0.0
        lacks = value - present > _SLACK * value
        exceeds = exactly and value > 0.0 and present - value > _SLACK * value
        if lacks or exceeds:
            differences.append(
                message(
                    "engine",
                    "axis {name}: ${setting} = {present}, the file has {value} {unit} "
                    "(${setting}={value})",
                ).fill(
                    name=axis.name,
                    setting=first + axis.number,
                    present=fixed(present, 3),
                    value=fixed(value, 3),
                    unit=units[first],
                )
            )
    return differences


def check_stage(robot: Robot, letters: str) -> None:
    """Refuse a robot that no controller of so many letters moves.

    Raises
    ------
    InputError
        With the axis, and what to do.
    """
    if len(robot.axes) > len(letters):
        raise InputError(
            message(
                "engine", "robot {name} has {count} axes; the letters {letters} name {letter_count}"
            ).fill(
                name=repr(robot.name),
                count=len(robot.axes),
                letters=repr(letters),
                letter_count=len(letters),
            )
        )
    for name, axis in robot.axes.items():
        if not isinstance(axis, StepperAxis):
            raise InputError(
                message(
                    "engine",
                    "robot {robot}: axis {axis} is moved by a {kind}, but a G-code "
                    "controller moves stepping motors; choose a robot file with such axes "
                    "only, such as xyz",
                ).fill(robot=repr(robot.name), axis=name, kind=axis.kind)
            )


def feed_of(way: Mapping[StageAxis, float], seconds: float) -> float:
    """Return F for a distance, mm or degrees of each axis, in a time: per minute, rounded down."""
    length = sqrt(sum(part * part for part in way.values()))
    return max(floor(60e3 * length / seconds) / 1e3, _DIGIT)
