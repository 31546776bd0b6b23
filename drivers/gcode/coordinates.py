"""A robot's axes in a GRBL controller's machine coordinates, which are in mm or degrees.

GRBL's coordinates go from minus the travel (``$130`` and following) to 0, regardless of the end at
which the switch is. With a forced origin (GRBL's option Z, bit 3 of ``$22`` in grblHAL) they are 0
at the switch. In FluidNC the configuration states the position of the switch. The low end of an
axis' range is the low end of its travel.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import floor, pi, sqrt
from typing import Self

from rotemina.drivers.contract import ReadingBounds
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed, join_messages, message
from rotemina.sim.robot import Robot, StepperAxis

# From m to mm, and from rad to degrees.
_SCALE_BY_UNIT = {"m": 1000.0, "rad": 180.0 / pi}
# Reports have three decimals.
_REPORT_STEP = 1e-3
# Numbers of the settings of the first axis. The settings of the other axes follow.
_FIRST_STEPS_SETTING, _FIRST_RATE_SETTING, _FIRST_ACCELERATION_SETTING, _FIRST_TRAVEL_SETTING = (
    100,
    110,
    120,
    130,
)
_S_PER_MINUTE = 60.0
# Relative rounding error of settings, which have three decimals.
_SETTING_ROUNDING_RATIO = 1e-6
# One step allows for the rounding of a report, and one for the rounding of a target.
_TOLERANCE_STEPS = 2.0


@dataclass(frozen=True, slots=True)
class StageAxis:
    """One axis of a controller.

    Attributes
    ----------
    name : str
        Name in the robot file.
    letter : str
    number : int
        Index in reports and settings.
    scale : float
        Controller units (mm, degrees) per robot unit (m, rad).
    low, high : float
        Ends of the range, m or rad.
    travel, resolution : float
        Travel of the controller's axis, and the smallest step that it reports, m or rad.
    speed, acceleration : float
        Maximum values, m/s and m/s² or rad/s and rad/s².
    origin : float
        Low end of the range in the controller's coordinates, mm or degrees.
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
        """Create an axis from the robot file and the controller's settings.

        Raises
        ------
        InputError
            If a setting is missing.
        """
        axis = robot.axes[name]
        scale = _SCALE_BY_UNIT[robot.unit(name) or "m"]

        def read_setting(first_setting: int) -> float:
            setting = settings.find_number(first_setting + number)
            if setting is None or setting <= 0.0:
                raise InputError(
                    "axis {name}: the controller has no setting ${first}; it needs one for "
                    "each of the {count} axes",
                    name=name,
                    first=first_setting + number,
                    count=len(robot.axes),
                )
            return setting

        travel = read_setting(_FIRST_TRAVEL_SETTING)
        speed = read_setting(_FIRST_RATE_SETTING) / _S_PER_MINUTE / scale
        return cls(
            name,
            letter,
            number,
            scale,
            *axis.range,
            travel / scale,
            max(_REPORT_STEP, 1.0 / read_setting(_FIRST_STEPS_SETTING)) / scale,
            min(speed, axis.max_speed or speed),
            read_setting(_FIRST_ACCELERATION_SETTING) / scale,
            settings.find_declared_low_end(letter, number, travel),
        )

    @property
    def tolerance(self) -> float:
        """Maximum difference between a reported position and the true step count, m or rad."""
        return _TOLERANCE_STEPS * self.resolution

    @property
    def reading_bounds(self) -> ReadingBounds:
        """Bounds of plausible readings of this axis."""
        return ReadingBounds(self.low, self.high, self.speed, self.tolerance)

    @property
    def permitted_targets(self) -> tuple[float, float]:
        """Ends of the range in the controller's coordinates."""
        return self.to_controller(self.low), self.to_controller(self.high)

    def with_homed_origin(self, homed_at: float, settings: ControllerSettings) -> Self:
        """Return a copy whose origin agrees with the controller's position after homing.

        Raises
        ------
        InputError
            If the position is outside the controller's travel or the range of the robot file.
        """
        travel = self.travel * self.scale
        origin = settings.find_low_end_after_homing(self.letter, self.number, travel, homed_at)
        relocated = self if origin is None else replace(self, origin=origin)
        position = relocated.from_controller(homed_at)
        if (
            origin is not None
            and self.low - self.tolerance <= position <= self.high + self.tolerance
        ):
            return relocated
        unit = "mm" if self.scale == _SCALE_BY_UNIT["m"] else "deg"
        raise InputError(
            "axis {name}: after homing the controller counts {count} {unit}, which is not "
            "within its range: the robot file has {low} to {high} {unit}, the controller "
            "travels {travel} {unit} (${setting}). Correct ${setting} and the homing settings "
            "($22, $23, $27), or the robot file",
            name=self.name,
            count=format_fixed(homed_at, 3),
            unit=unit,
            low=format_fixed(self.low * self.scale, 3),
            high=format_fixed(self.high * self.scale, 3),
            travel=format_fixed(travel, 3),
            setting=_FIRST_TRAVEL_SETTING + self.number,
        )

    def to_controller(self, value: float) -> float:
        """Convert a position, m or rad, to the controller's coordinates.

        The position is clipped to the range, and the result is rounded.
        """
        clipped = min(max(value, self.low), self.high)
        return round(self.origin + (clipped - self.low) * self.scale, 3)

    def from_controller(self, number: float) -> float:
        """Convert a position in a report to m or rad."""
        return self.low + (number - self.origin) / self.scale


def check_agreement(robot: Robot, axes: Sequence[StageAxis], settings: ControllerSettings) -> None:
    """Raise if a controller's travel, speed or acceleration does not match the robot file.

    Raises
    ------
    InputError
        If a value differs. The message lists the differences and the settings to send.
    """
    differences = [
        difference for axis in axes for difference in _find_differences(robot, axis, settings)
    ]
    if differences:
        raise InputError(
            "the controller's settings do not agree with the robot file: {differences}. Send "
            "them to the controller, or correct the file",
            differences=join_messages(differences, ", "),
        )


def _find_differences(robot: Robot, axis: StageAxis, settings: ControllerSettings) -> list[str]:
    robot_axis = robot.axes[axis.name]
    per_minute = _S_PER_MINUTE * axis.scale
    # Each setting has the value in the file, and whether it must be equal. Travel and speed may be
    # greater. Acceleration must be equal: a greater one may lose steps, and a smaller one makes
    # the stopping distance longer.
    required = {
        _FIRST_TRAVEL_SETTING: (robot_axis.span * axis.scale, False),
        _FIRST_RATE_SETTING: ((robot_axis.max_speed or 0.0) * per_minute, False),
        _FIRST_ACCELERATION_SETTING: ((robot_axis.max_acceleration or 0.0) * axis.scale, True),
    }
    unit = "mm" if axis.scale == _SCALE_BY_UNIT["m"] else "deg"
    units = {
        _FIRST_TRAVEL_SETTING: unit,
        _FIRST_RATE_SETTING: f"{unit}/min",
        _FIRST_ACCELERATION_SETTING: f"{unit}/s²",
    }
    differences: list[str] = []
    for first_setting, (value, must_equal) in required.items():
        actual = settings.find_number(first_setting + axis.number) or 0.0
        is_too_small = value - actual > _SETTING_ROUNDING_RATIO * value
        is_too_large = (
            must_equal and value > 0.0 and actual - value > _SETTING_ROUNDING_RATIO * value
        )
        if is_too_small or is_too_large:
            differences.append(
                message(
                    "engine",
                    "axis {name}: ${setting} = {present}, the file has {value} {unit} "
                    "(${setting}={value})",
                ).fill(
                    name=axis.name,
                    setting=first_setting + axis.number,
                    present=format_fixed(actual, 3),
                    value=format_fixed(value, 3),
                    unit=units[first_setting],
                )
            )
    return differences


def check_stage(robot: Robot, letters: str) -> None:
    """Raise if a controller with these axis letters cannot move the robot.

    Raises
    ------
    InputError
        If there are too few letters, or an axis is not moved by a stepping motor.
    """
    if len(robot.axes) > len(letters):
        raise InputError(
            "robot {name} has {count} axes; the letters {letters} name {letter_count}",
            name=repr(robot.name),
            count=len(robot.axes),
            letters=repr(letters),
            letter_count=len(letters),
        )
    for name, axis in robot.axes.items():
        if not isinstance(axis, StepperAxis):
            raise InputError(
                "robot {robot}: axis {axis} is moved by a {kind}, but a G-code "
                "controller moves stepping motors; choose a robot file with such axes "
                "only, such as xyz",
                robot=repr(robot.name),
                axis=name,
                kind=axis.kind,
            )


def compute_feed(distances: Mapping[StageAxis, float], seconds: float) -> float:
    """Return the feed rate F, per minute, that takes a given time for a path, rounded down.

    ``distances`` contains the distance of each axis, mm or degrees.
    """
    length = sqrt(sum(distance * distance for distance in distances.values()))
    return max(floor(60e3 * length / seconds) / 1e3, _REPORT_STEP)
