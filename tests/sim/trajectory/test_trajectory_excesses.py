"""What trajectories exceed, against exact cases."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.resampling import resample
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory import speed_and_acceleration
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.speed_and_acceleration import window_rows
from rotemina.sim.trajectory.trajectory_excesses import (
    Quantity,
    TrajectoryError,
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
    assert str(speed) == speed.message


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


@pytest.mark.parametrize("rate_hz", [1000.0, 10_000.0])
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
    rows = window_rows(1e-3, 1e-7, 0.2)
    assert rows == 7
    assert 4 * 1e-7 / (rows * 1e-3) ** 2 <= 0.05 * 0.2 < 4 * 1e-7 / ((rows - 1) * 1e-3) ** 2
    assert window_rows(1e-3, 0.0, 0.2) == 1


def test_range_and_voltage_report_the_worst_row():
    command = np.array([60e-6, 66e-6, 70e-6, 64e-6])
    robot = with_axis("zn", max_speed=None, max_acceleration=None)
    violations = found(robot, trajectory("zn", command))
    assert set(violations) == {Quantity.RANGE, Quantity.VOLTAGE}
    assert violations[Quantity.RANGE].value == 70e-6
    assert violations[Quantity.RANGE].time_s == pytest.approx(0.002)
    assert violations[Quantity.VOLTAGE].value == pytest.approx(140.0)


def rows(time_s, command):
    return Record.from_signals(np.array(time_s), {("x", Tap.CMD): np.array(command)}, {"x": "m"})


def test_a_jump_between_distant_rows_takes_the_device_a_millisecond():
    """The device holds a row until the next: no straight line joins them."""
    violations = found(ROBOT, rows([0.0, 10.0, 20.0], [0.0, 0.05, 0.0]))
    assert set(violations) == {Quantity.SPEED, Quantity.ACCELERATION}
    speed = violations[Quantity.SPEED]
    assert abs(speed.value) == pytest.approx(50.0)
    for word in ("50000 mm/s", "10 s apart", "holds each", "1000 Hz", "linear or cubic"):
        assert word in speed.message
    assert "stretch" not in speed.message
    assert "1000 Hz" in violations[Quantity.ACCELERATION].message


def test_distant_rows_that_are_too_far_apart_even_for_a_line_are_to_be_stretched_too():
    message = found(ROBOT, rows([0.0, 1.0], [0.0, 0.05]))[Quantity.SPEED].message
    assert "1000 Hz" in message
    assert "stretch its time by a factor of 5 " in message


@pytest.mark.parametrize("method", ["linear", "cubic"])
def test_resampling_as_the_message_says_makes_a_slow_trajectory_playable(method):
    time_s = np.arange(41) * 0.25
    slow = rows(time_s, 0.02 + 0.005 * np.sin(np.pi * time_s / 10) ** 4)
    assert found(ROBOT, slow)
    # A line turns at its rows, which only a bound on acceleration minds.
    robot = ROBOT if method == "cubic" else with_axis("x", max_acceleration=None)
    assert found(robot, resample(slow, 1000.0, method)) == {}


@pytest.mark.parametrize("interval_s", [0.002, 0.01, 0.5, 100.0])
def test_a_held_jump_is_a_start_and_a_halt_however_long_the_rows_are_held(interval_s):
    """From rest to rest by s: ±s/w², over a window w of seven periods."""
    robot, step = with_axis("x", max_speed=None), 2e-5
    jump = rows(np.arange(4) * interval_s, [0.01, 0.01, 0.01 + step, 0.01 + step])
    violations = found(robot, jump)
    assert set(violations) == {Quantity.ACCELERATION}
    value = abs(violations[Quantity.ACCELERATION].value)
    assert value == pytest.approx(step / 7e-3**2, rel=1e-6)


def test_an_axis_that_can_hardly_start_is_judged_without_an_endless_window():
    robot = with_axis("x", max_speed=None, max_acceleration=1e-20)
    violations = found(robot, trajectory("x", ramp(0.01, 0.001, 0.1)))
    assert violations[Quantity.ACCELERATION].bound == 1e-20


def test_rows_that_come_a_little_late_are_followed_not_held():
    """A recorded command has jitter; a stand of 10 µs would pose as a halt."""
    robot = with_axis("x", sensor=None)
    late = np.random.default_rng(0).uniform(0.8e-3, 1.2e-3, 2000).cumsum()
    assert found(robot, rows(late, 0.02 + 0.002 * np.cos(late * np.pi / late[-1]) ** 2)) == {}
    assert found(robot, rows(2 * late, 0.02 + 0.002 * np.cos(late * np.pi / late[-1]) ** 2))


def test_steps_of_one_resolution_may_be_as_far_apart_as_they_like():
    steps = 0.01 + 1e-7 * np.arange(50)
    assert find_violations(ROBOT, trajectory("x", steps, rate_hz=20.0)) == ()


def test_a_device_with_shorter_periods_is_stricter():
    record = trajectory("x", ramp(0.01, 0.008, 0.10), rate_hz=1000.0)
    assert find_violations(ROBOT, record) == ()
    stricter = find_violations(ROBOT, record, setpoint_period_s=5e-4)
    assert stricter[0].quantity is Quantity.SPEED
    assert "2000 Hz" in stricter[0].message
    check_trajectory(ROBOT, record)
    with pytest.raises(OutOfLimitsError, match="2000 Hz"):
        check_trajectory(ROBOT, record, setpoint_period_s=5e-4)


@pytest.mark.parametrize("rate_hz", [50.0, 1000.0])
def test_a_long_trajectory_is_judged_piece_by_piece_as_a_whole(monkeypatch, rate_hz):
    rng = np.random.default_rng(3)
    record = trajectory("x", 0.02 + 1e-5 * rng.standard_normal(2000).cumsum(), rate_hz=rate_hz)
    whole = find_violations(ROBOT, record)
    monkeypatch.setattr(speed_and_acceleration, "_BLOCK", 400)
    assert find_violations(ROBOT, record) == whole
    assert whole


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
