"""Limits of targets and trajectories, against exact cases."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.kinematics import window_rows
from rotemina.sim.trajectory.limits import (
    OutOfLimitsError,
    Quantity,
    TrajectoryError,
    check_target,
    check_trajectory,
    find_violations,
)

ROBOT = load_robot("rotemina")
RATE_HZ = 1000.0


def with_axis(name, **changes):
    return replace(ROBOT, axes={**ROBOT.axes, name: replace(ROBOT.axes[name], **changes)})


def trajectory(axis, command, unit="m", rate_hz=RATE_HZ):
    command = np.asarray(command, dtype=float)
    time_s = np.arange(len(command)) / rate_hz
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit})


def ramp(start, speed, acceleration, cruise_s=0.2, rate_hz=RATE_HZ):
    """From rest to a speed and back to rest, each row's speed a multiple of a·dt."""
    steps = np.arange(0.0, speed, acceleration / rate_hz)
    cruise = np.full(round(cruise_s * rate_hz), speed)
    speeds = np.concatenate([steps, cruise, steps[::-1]])
    return start + np.concatenate([[0.0], np.cumsum(speeds)]) / rate_hz


def found(robot, record):
    return {violation.quantity: violation for violation in find_violations(robot, record)}


@pytest.mark.parametrize(
    ("axis", "position"),
    [("x", 0.0), ("x", 0.055), ("x", 0.055 * (1 + 1e-12)), ("thx", 1.16355e-3), ("zn", 65e-6)],
)
def test_targets_to_the_very_ends_are_allowed(axis, position):
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
def test_a_target_beyond_is_refused_with_value_and_bound(axis, position, words):
    with pytest.raises(OutOfLimitsError) as caught:
        check_target(ROBOT, axis, position)
    for word in words:
        assert word in str(caught.value)


def test_a_target_that_needs_too_much_voltage_is_refused():
    robot = with_axis("zn", voltage_range=(0.0, 100.0))
    check_target(robot, "zn", 50e-6)
    check_target(robot, "zn", 50e-6 * (1 + 0.9e-6))
    with pytest.raises(OutOfLimitsError, match=r"axis zn.*120 V.*100 V"):
        check_target(robot, "zn", 60e-6)


def test_a_ramp_at_exactly_both_bounds_is_allowed():
    assert find_violations(ROBOT, trajectory("x", ramp(0.01, 0.010, 0.20))) == ()


def test_too_fast_is_told_with_its_time_and_factor():
    violations = found(ROBOT, trajectory("x", ramp(0.01, 0.020, 0.20)))
    assert set(violations) == {Quantity.SPEED}
    speed = violations[Quantity.SPEED]
    assert speed.value == pytest.approx(0.020)
    assert speed.bound == 0.010
    assert speed.unit == "m/s"
    assert 0.1 <= speed.time_s <= 0.3
    for word in ("axis x", "20 mm/s", "10 mm/s", "factor of 2 "):
        assert word in speed.message


def test_the_speed_bound_forgives_one_resolution_and_no_more():
    robot = with_axis("x", max_acceleration=None)
    resolution = robot.axes["x"].sensor.resolution
    step = 0.010 / RATE_HZ
    allowed = np.cumsum([0.01, step, step + 0.9 * resolution, step])
    assert find_violations(robot, trajectory("x", allowed)) == ()
    beyond = np.cumsum([0.01, step, step + 1.1 * resolution, step])
    assert set(found(robot, trajectory("x", beyond))) == {Quantity.SPEED}


def test_too_abrupt_is_told():
    violations = found(ROBOT, trajectory("x", ramp(0.01, 0.009, 0.40)))
    assert set(violations) == {Quantity.ACCELERATION}
    assert abs(violations[Quantity.ACCELERATION].value) == pytest.approx(0.40)
    assert "m/s²" in violations[Quantity.ACCELERATION].message


@pytest.mark.parametrize("turn", [1, -1])
def test_starting_and_ending_in_motion_counts_as_acceleration(turn):
    moving = 0.02 + 0.005 * np.arange(300) / RATE_HZ
    violations = found(ROBOT, trajectory("x", moving[::turn]))
    assert set(violations) == {Quantity.ACCELERATION}


@pytest.mark.parametrize("rate_hz", [200.0, 1000.0, 10_000.0])
def test_rounding_to_the_resolution_poses_as_no_acceleration(rate_hz):
    resolution = ROBOT.axes["x"].sensor.resolution
    smooth = ramp(0.01, 0.010, 0.19, rate_hz=rate_hz)
    rounded = np.rint(smooth / resolution) * resolution
    assert find_violations(ROBOT, trajectory("x", rounded, rate_hz=rate_hz)) == ()


def test_the_acceleration_bound_forgives_rounding_and_no_more():
    resolution = ROBOT.axes["x"].sensor.resolution

    def rounded(acceleration):
        smooth = ramp(0.01, 0.009, acceleration, rate_hz=1000.0)
        return trajectory("x", np.rint(smooth / resolution) * resolution)

    assert find_violations(ROBOT, rounded(0.1999)) == ()
    assert set(found(ROBOT, rounded(0.22))) == {Quantity.ACCELERATION}


def test_the_window_weighs_one_rounding_at_five_percent():
    time_s = np.arange(100) / 1000.0
    rows = window_rows(time_s, 1e-7, 0.2)
    assert rows == 7
    assert 4 * 1e-7 / (rows * 1e-3) ** 2 <= 0.05 * 0.2 < 4 * 1e-7 / ((rows - 1) * 1e-3) ** 2
    assert window_rows(time_s, 0.0, 0.2) == 1


def test_range_and_voltage_report_the_worst_row():
    command = np.array([60e-6, 66e-6, 70e-6, 64e-6])
    robot = with_axis("zn", max_speed=None, max_acceleration=None)
    violations = found(robot, trajectory("zn", command))
    assert set(violations) == {Quantity.RANGE, Quantity.VOLTAGE}
    assert violations[Quantity.RANGE].value == 70e-6
    assert violations[Quantity.RANGE].time_s == pytest.approx(0.002)
    assert violations[Quantity.VOLTAGE].value == pytest.approx(140.0)


def test_undeclared_bounds_are_not_checked():
    jump = trajectory("m1", [0.0, 4e-6, -4e-6])
    assert find_violations(load_robot("fsm"), jump) == ()


def test_one_row_is_a_trajectory():
    assert find_violations(ROBOT, trajectory("x", [0.01])) == ()


def test_all_violations_are_in_the_refusal():
    both = trajectory("x", [0.0, 0.06, 0.0])
    with pytest.raises(OutOfLimitsError) as caught:
        check_trajectory(ROBOT, both)
    assert len(str(caught.value).splitlines()) == 3


@pytest.mark.parametrize(
    ("robot", "record", "words"),
    [
        (ROBOT, trajectory("q", [0.0]), "no axis 'q'"),
        (ROBOT, trajectory("x", [0.0], unit="rad"), "in rad"),
        (
            ROBOT,
            Record.from_signals(np.arange(2.0), {("x", Tap.MEAS): np.zeros(2)}, {"x": "m"}),
            "no set-point",
        ),
        (
            replace(
                load_robot("emps"),
                axes={"q": replace(load_robot("emps").axes["q"], controller=None)},
            ),
            trajectory("q", [0.0]),
            "no controller",
        ),
    ],
)
def test_a_trajectory_for_another_machine_is_refused(robot, record, words):
    with pytest.raises(TrajectoryError, match=words):
        find_violations(robot, record)
