"""Whether a GRBL controller's axes and settings match the robot file."""

from collections.abc import Sequence

from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.coordinates import (
    FIRST_ACCELERATION_SETTING,
    FIRST_RATE_SETTING,
    FIRST_TRAVEL_SETTING,
    S_PER_MINUTE,
    SCALE_BY_UNIT,
    StageAxis,
)
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed, join_messages, message
from rotemina.sim.robot import Robot, StepperAxis

# Relative rounding error of settings, which have three decimals.
_SETTING_ROUNDING_RATIO = 1e-6


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
    per_minute = S_PER_MINUTE * axis.scale
    # Each setting has the value in the file, and whether it must be equal. Travel and speed may be
    # greater. Acceleration must be equal: a greater one may lose steps, and a smaller one makes
    # the stopping distance longer.
    required = {
        FIRST_TRAVEL_SETTING: (robot_axis.span * axis.scale, False),
        FIRST_RATE_SETTING: ((robot_axis.max_speed or 0.0) * per_minute, False),
        FIRST_ACCELERATION_SETTING: ((robot_axis.max_acceleration or 0.0) * axis.scale, True),
    }
    unit = "mm" if axis.scale == SCALE_BY_UNIT["m"] else "deg"
    units = {
        FIRST_TRAVEL_SETTING: unit,
        FIRST_RATE_SETTING: f"{unit}/min",
        FIRST_ACCELERATION_SETTING: f"{unit}/s²",
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
