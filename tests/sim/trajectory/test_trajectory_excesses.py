"""Violations of limits by trajectories, in exact cases."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import OutOfLimitsError, TrajectoryError
from rotemina.sim.records import Record, Tap, resample
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import LimitedQuantity, check_trajectory, speed_and_acceleration
from rotemina.sim.trajectory.speed_and_acceleration import count_window_intervals
from rotemina.sim.trajectory.trajectory_excesses import find_violations

ROBOT = load_robot("rotemina")
RATE_HZ = 1000.0


def replace_axis_fields(name, **changes):
    return replace(ROBOT, axes={**ROBOT.axes, name: replace(ROBOT.axes[name], **changes)})


def make_trajectory(axis, command, unit="m", rate_hz=RATE_HZ):
    command = np.asarray(command, dtype=float)
    time_s = np.arange(len(command)) / rate_hz
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit})


def make_ramp(start, speed, acceleration, cruise_s=0.2, rate_hz=RATE_HZ):
    """Return positions from rest to a speed and back to rest, in speed steps of a·dt."""
    steps = np.arange(0.0, speed, acceleration / rate_hz)
    cruise = np.full(round(cruise_s * rate_hz), speed)
    speeds = np.concatenate([steps, cruise, steps[::-1]])
    return start + np.concatenate([[0.0], np.cumsum(speeds)]) / rate_hz


def get_violations(robot, record):
    return {violation.quantity: violation for violation in find_violations(robot, record)}


def test_a_single_row_and_a_ramp_at_exactly_both_bounds_are_allowed():
    assert find_violations(ROBOT, make_trajectory("x", [0.01])) == ()
    assert find_violations(ROBOT, make_trajectory("x", make_ramp(0.01, 0.010, 0.20))) == ()


def test_excess_speed_is_reported_with_time_and_factor():
    violations = get_violations(ROBOT, make_trajectory("x", make_ramp(0.01, 0.020, 0.20)))
    assert set(violations) == {LimitedQuantity.SPEED}
    speed = violations[LimitedQuantity.SPEED]
    assert speed.value == pytest.approx(0.020)
    assert speed.bound == 0.010
    assert speed.unit == "m/s"
    assert 0.1 <= speed.time_s <= 0.3
    for word in ("axis x", "20 mm/s", "10 mm/s", "factor of 2 "):
        assert word in speed.message
    assert str(speed) == speed.message


def test_the_speed_bound_tolerates_one_resolution():
    robot = replace_axis_fields("x", max_acceleration=None)
    resolution = robot.axes["x"].sensor.resolution
    step = 0.010 / RATE_HZ
    allowed = np.cumsum([0.01, step, step + 0.9 * resolution, step])
    assert find_violations(robot, make_trajectory("x", allowed)) == ()
    beyond = np.cumsum([0.01, step, step + 1.1 * resolution, step])
    assert set(get_violations(robot, make_trajectory("x", beyond))) == {LimitedQuantity.SPEED}


@pytest.mark.parametrize("direction", [1, -1])
def test_starting_and_ending_in_motion_counts_as_acceleration(direction):
    positions = 0.02 + 0.005 * np.arange(300) / RATE_HZ
    violations = get_violations(ROBOT, make_trajectory("x", positions[::direction]))
    assert set(violations) == {LimitedQuantity.ACCELERATION}


@pytest.mark.parametrize("rate_hz", [1000.0, 10_000.0])
def test_rounding_to_the_resolution_does_not_count_as_acceleration(rate_hz):
    resolution = ROBOT.axes["x"].sensor.resolution
    smooth = make_ramp(0.01, 0.010, 0.19, rate_hz=rate_hz)
    rounded = np.rint(smooth / resolution) * resolution
    assert find_violations(ROBOT, make_trajectory("x", rounded, rate_hz=rate_hz)) == ()


def test_excess_acceleration_is_reported_but_rounding_is_tolerated():
    resolution = ROBOT.axes["x"].sensor.resolution

    def make_rounded_ramp(acceleration):
        smooth = make_ramp(0.01, 0.009, acceleration, rate_hz=1000.0)
        return make_trajectory("x", np.rint(smooth / resolution) * resolution)

    assert find_violations(ROBOT, make_rounded_ramp(0.1999)) == ()
    violations = get_violations(ROBOT, make_trajectory("x", make_ramp(0.01, 0.009, 0.40)))
    assert set(violations) == {LimitedQuantity.ACCELERATION}
    assert abs(violations[LimitedQuantity.ACCELERATION].value) == pytest.approx(0.40)
    assert "m/s²" in violations[LimitedQuantity.ACCELERATION].message
    assert set(get_violations(ROBOT, make_rounded_ramp(0.22))) == {LimitedQuantity.ACCELERATION}


def test_rounding_is_at_most_five_percent_of_the_bound_over_the_window():
    intervals = count_window_intervals(1e-3, 1e-7, 0.2)
    assert intervals == 7
    assert (
        4 * 1e-7 / (intervals * 1e-3) ** 2 <= 0.05 * 0.2 < 4 * 1e-7 / ((intervals - 1) * 1e-3) ** 2
    )
    assert count_window_intervals(1e-3, 0.0, 0.2) == 1


def test_range_and_voltage_are_reported_for_the_worst_row():
    command = np.array([60e-6, 66e-6, 70e-6, 64e-6])
    robot = replace_axis_fields("zn", max_speed=None, max_acceleration=None)
    violations = get_violations(robot, make_trajectory("zn", command))
    assert set(violations) == {LimitedQuantity.RANGE, LimitedQuantity.VOLTAGE}
    assert violations[LimitedQuantity.RANGE].value == 70e-6
    assert violations[LimitedQuantity.RANGE].time_s == pytest.approx(0.002)
    assert violations[LimitedQuantity.VOLTAGE].value == pytest.approx(140.0)


def make_rows(time_s, command):
    return Record.from_signals(np.array(time_s), {("x", Tap.CMD): np.array(command)}, {"x": "m"})


def test_a_jump_between_distant_rows_happens_within_a_millisecond():
    """The device holds each row until the next one and does not interpolate."""
    violations = get_violations(ROBOT, make_rows([0.0, 10.0, 20.0], [0.0, 0.05, 0.0]))
    assert set(violations) == {LimitedQuantity.SPEED, LimitedQuantity.ACCELERATION}
    speed = violations[LimitedQuantity.SPEED]
    assert abs(speed.value) == pytest.approx(50.0)
    for word in ("50000 mm/s", "10 s apart", "holds each", "1000 Hz", "linear or cubic"):
        assert word in speed.message
    assert "stretch" not in speed.message
    assert "1000 Hz" in violations[LimitedQuantity.ACCELERATION].message
    # For this jump, resampling is not enough.
    faster = get_violations(ROBOT, make_rows([0.0, 1.0], [0.0, 0.05]))[LimitedQuantity.SPEED]
    assert "1000 Hz" in faster.message
    assert "stretch its time by a factor of 5 " in faster.message


@pytest.mark.parametrize("method", ["linear", "cubic"])
def test_resampling_makes_a_slow_trajectory_playable(method):
    time_s = np.arange(41) * 0.25
    trajectory = make_rows(time_s, 0.02 + 0.005 * np.sin(np.pi * time_s / 10) ** 4)
    assert get_violations(ROBOT, trajectory)
    # A line has corners at its rows, which violate only a bound on acceleration.
    robot = ROBOT if method == "cubic" else replace_axis_fields("x", max_acceleration=None)
    assert get_violations(robot, resample(trajectory, 1000.0, method)) == {}


@pytest.mark.parametrize("interval_s", [0.002, 100.0])
def test_the_acceleration_of_a_jump_does_not_depend_on_the_hold_time(interval_s):
    """A step of s from rest to rest is ±s/w² over a window w of seven periods."""
    robot, step = replace_axis_fields("x", max_speed=None), 2e-5
    jump = make_rows(np.arange(4) * interval_s, [0.01, 0.01, 0.01 + step, 0.01 + step])
    violations = get_violations(robot, jump)
    assert set(violations) == {LimitedQuantity.ACCELERATION}
    value = abs(violations[LimitedQuantity.ACCELERATION].value)
    assert value == pytest.approx(step / 7e-3**2, rel=1e-6)


def test_a_tiny_acceleration_bound_has_a_finite_window():
    robot = replace_axis_fields("x", max_speed=None, max_acceleration=1e-20)
    violations = get_violations(robot, make_trajectory("x", make_ramp(0.01, 0.001, 0.1)))
    assert violations[LimitedQuantity.ACCELERATION].bound == 1e-20


def test_rows_with_jitter_do_not_count_as_held():
    """A recorded command has jitter, and holding it for 10 µs would look like a stop."""
    robot = replace_axis_fields("x", sensor=None)
    time_s = np.random.default_rng(0).uniform(0.8e-3, 1.2e-3, 2000).cumsum()
    assert (
        get_violations(
            robot, make_rows(time_s, 0.02 + 0.002 * np.cos(time_s * np.pi / time_s[-1]) ** 2)
        )
        == {}
    )
    assert get_violations(
        robot, make_rows(2 * time_s, 0.02 + 0.002 * np.cos(time_s * np.pi / time_s[-1]) ** 2)
    )


def test_steps_of_one_resolution_are_allowed_at_any_distance():
    steps = 0.01 + 1e-7 * np.arange(50)
    assert find_violations(ROBOT, make_trajectory("x", steps, rate_hz=20.0)) == ()


def test_a_device_with_shorter_periods_is_stricter():
    record = make_trajectory("x", make_ramp(0.01, 0.008, 0.10), rate_hz=1000.0)
    assert find_violations(ROBOT, record) == ()
    stricter = find_violations(ROBOT, record, setpoint_period_s=5e-4)
    assert stricter[0].quantity is LimitedQuantity.SPEED
    assert "2000 Hz" in stricter[0].message
    check_trajectory(ROBOT, record)
    with pytest.raises(OutOfLimitsError, match="2000 Hz"):
        check_trajectory(ROBOT, record, setpoint_period_s=5e-4)


@pytest.mark.parametrize("rate_hz", [50.0, 1000.0])
def test_a_check_in_blocks_equals_the_whole(monkeypatch, rate_hz):
    rng = np.random.default_rng(3)
    record = make_trajectory("x", 0.02 + 1e-5 * rng.standard_normal(2000).cumsum(), rate_hz=rate_hz)
    whole = find_violations(ROBOT, record)
    monkeypatch.setattr(speed_and_acceleration, "_BLOCK_POINTS", 400)
    assert find_violations(ROBOT, record) == whole
    assert whole


def test_undeclared_bounds_are_not_checked():
    jump = make_trajectory("m1", [0.0, 4e-6, -4e-6])
    assert find_violations(load_robot("fsm"), jump) == ()


def test_all_violations_are_in_the_refusal():
    record = make_trajectory("x", [0.0, 0.06, 0.0])
    with pytest.raises(OutOfLimitsError) as refusal:
        check_trajectory(ROBOT, record)
    assert len(str(refusal.value).splitlines()) == 3


@pytest.mark.parametrize(
    ("robot", "record", "words"),
    [
        (ROBOT, make_trajectory("q", [0.0]), "no axis 'q'"),
        (ROBOT, make_trajectory("x", [0.0], unit="rad"), "in units of rad"),
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
            make_trajectory("q", [0.0]),
            "no controller",
        ),
    ],
)
def test_a_trajectory_for_another_machine_is_refused(robot, record, words):
    with pytest.raises(TrajectoryError, match=words):
        find_violations(robot, record)
