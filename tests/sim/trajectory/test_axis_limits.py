"""Limits of targets and speeds in exact cases."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import check_speeds, check_target

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(
    ("axis", "position"),
    [("x", 0.0), ("x", 0.055), ("x", 0.055 * (1 + 1e-12)), ("thx", 1.16355e-3), ("zn", 65e-6)],
)
def test_targets_up_to_the_ends_are_allowed(axis, position):
    check_target(ROBOT, axis, position)


@pytest.mark.parametrize(
    ("axis", "position", "words"),
    [
        ("x", 0.0551, ["axis x", "55.1 mm", "0 mm", "55 mm"]),
        ("x", -1e-7, ["axis x", "range"]),
        ("thx", 1.2e-3, ["axis thx", "1.2 mrad"]),
        ("x", float("nan"), ["axis x", "finite"]),
        ("x", float("inf"), ["axis x", "finite"]),
        ("w", 0.0, ["'w'", "no such axis", "thx"]),
    ],
)
def test_a_target_out_of_range_is_refused_with_value_and_bound(axis, position, words):
    with pytest.raises(OutOfLimitsError) as refusal:
        check_target(ROBOT, axis, position)
    for word in words:
        assert word in str(refusal.value)


def test_a_target_that_needs_too_much_voltage_is_refused():
    axes = {**ROBOT.axes, "zn": replace(ROBOT.axes["zn"], voltage_range=(0.0, 100.0))}
    robot = replace(ROBOT, axes=axes)
    check_target(robot, "zn", 50e-6)
    check_target(robot, "zn", 50e-6 * (1 + 0.9e-6))
    with pytest.raises(OutOfLimitsError, match=r"axis zn.*120 V.*100 V"):
        check_target(robot, "zn", 60e-6)


@pytest.mark.parametrize("speed", ["0.01", None, 0.0, -1.0, float("nan"), float("inf"), 1j])
def test_an_invalid_speed_is_refused(speed):
    with pytest.raises(OutOfLimitsError, match=r"axis x: speed .*: must be a finite number"):
        check_speeds({"x": 0.0}, {"x": speed})


def test_a_speed_without_a_target_is_refused():
    check_speeds({"x": 0.0}, {"x": np.float32(1e-3)})
    with pytest.raises(OutOfLimitsError, match=r"axis y: .* with a target"):
        check_speeds({"x": 0.0}, {"y": 1e-3})
