"""Checks of motion at a given velocity, which lasts until its lease expires."""

import numpy as np

from rotemina.drivers.abilities import MAX_LEASE_S, VelocityMover
from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import (
    MAX_MOTION_S,
    AxisUnderTest,
    DriverUnderTest,
    find_sample_interval,
)
from rotemina.drivers.conformance.findings import require_at_most, require_refusal, require_that
from rotemina.drivers.conformance.moves import MAX_STOP_DELAY_S, require_halt
from rotemina.drivers.contract import DeviceSamples, DeviceState, LimitError

# Fraction of full speed. Half speed reveals both motion that is too fast and too slow.
_SPEED_RATIO = 0.5
_LEASE_S = 0.2
# A device may check leases at its own ticks, which must be at most 20 ms apart.
_MAX_LEASE_DELAY_S = 0.020
# Relative tolerance of a speed, because the device's unit of speed may be coarse.
_SPEED_TOLERANCE = 0.05


def _compute_test_velocity(subject: DriverUnderTest, axis: AxisUnderTest) -> float:
    """Return a velocity of half full speed, m/s or rad/s, towards the farther end of the range."""
    position = float(subject.read_command()[axis.index])
    return float(np.copysign(_SPEED_RATIO * axis.speed, axis.find_far_end(position) - position))


def _run_with_lease(
    subject: DriverUnderTest, axis: AxisUnderTest, velocity: float, seconds: float
) -> DeviceSamples:
    """Move an axis for some seconds, and renew its lease every half lease; return the samples."""
    driver = subject.driver
    assert isinstance(driver, VelocityMover), "a check runs only if the driver has the ability"
    parts = []
    for _ in range(round(seconds / (0.5 * _LEASE_S))):
        driver.move_velocity({axis.name: velocity}, _LEASE_S)
        parts.append(subject.run(0.5 * _LEASE_S))
    return DeviceSamples.join(parts, len(subject.axes))


@check(needs=VelocityMover)
def lease_expiry(bench: DriverBench) -> None:
    """When its lease expires, an axis brakes to a halt by itself, without a fault."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        assert isinstance(driver, VelocityMover), "a check runs only if the driver has the ability"
        velocity = _compute_test_velocity(subject, axis)
        start_s = float(subject.run_while(lambda latest: len(latest) == 0, 5.0).device_time_s[-1])
        driver.move_velocity({axis.name: velocity}, _LEASE_S)
        samples = subject.run(3.0 * _LEASE_S + abs(velocity) / axis.acceleration)
        moving = np.flatnonzero(np.abs(np.diff(samples.command[:, axis.index])) > axis.half_step)
        require_that(len(moving) > 0, f"axis {axis.name} did not move at a speed", "motion")
        duration_s = float(samples.device_time_s[moving[-1] + 1]) - start_s
        slack_s = (
            _MAX_LEASE_DELAY_S + subject.max_sample_age_s + 2.0 * find_sample_interval(samples)
        )
        bound_s = _LEASE_S + abs(velocity) / axis.acceleration + slack_s
        require_at_most(
            f"with a lease of {_LEASE_S:g} s axis {axis.name} moved for", duration_s, bound_s, "s"
        )
        status = driver.status()
        require_that(
            status.state is DeviceState.IDLE, f"it is {status.state} ({status.fault})", "idle"
        )
        subject.require_hold()


@check(needs=VelocityMover)
def lease_renewed(bench: DriverBench) -> None:
    """If its lease is renewed in time, an axis continues at the same speed, without a jump."""
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        velocity = _compute_test_velocity(subject, axis)
        _run_with_lease(subject, axis, velocity, abs(velocity) / axis.acceleration + _LEASE_S)
        samples = _run_with_lease(subject, axis, velocity, 0.6)
        subject.stop()
        distance = np.diff(samples.command[:, axis.index])
        expected = velocity * np.diff(samples.device_time_s)
        excess = np.abs(distance - expected) - _SPEED_TOLERANCE * np.abs(expected)
        worst = int(np.argmax(excess))
        require_at_most(
            f"at {abs(velocity):.3g} {axis.unit}/s axis {axis.name} is off in one sample by",
            float(excess[worst]),
            axis.resolution + 1e-9 * axis.span,
            axis.unit,
        )
        subject.run_until_idle()


@check(needs=VelocityMover)
def zero_velocity(bench: DriverBench) -> None:
    """A velocity of zero halts an axis within its stopping distance, whatever its lease."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        assert isinstance(driver, VelocityMover), "a check runs only if the driver has the ability"
        before = _run_with_lease(subject, axis, _compute_test_velocity(subject, axis), 0.3)
        driver.move_velocity({axis.name: 0.0}, MAX_LEASE_S)
        after = subject.run_until_idle()
        require_halt(subject, axis, before, after, max_delay_s=MAX_STOP_DELAY_S)
        subject.require_hold()


@check(needs=VelocityMover)
def stop_ends_leases(bench: DriverBench) -> None:
    """A stop halts an axis that moves at a speed, however long its lease still lasts."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        assert isinstance(driver, VelocityMover), "a check runs only if the driver has the ability"
        driver.move_velocity({axis.name: _compute_test_velocity(subject, axis)}, MAX_LEASE_S)
        before = subject.run(0.3)
        subject.stop()
        after = subject.run_until_idle()
        require_halt(subject, axis, before, after, max_delay_s=MAX_STOP_DELAY_S)
        subject.require_hold()


@check(needs=VelocityMover)
def refused_velocities(bench: DriverBench) -> None:
    """Speeds beyond an axis' limit, and leases of zero or too long, are refused."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        assert isinstance(driver, VelocityMover), "a check runs only if the driver has the ability"
        slow = 0.1 * axis.speed
        requests = {
            "a speed that is not a number": ({axis.name: float("nan")}, _LEASE_S),
            "a speed of an unknown axis": ({axis.name: slow, "elbow": 0.0}, _LEASE_S),
            "a lease of zero": ({axis.name: slow}, 0.0),
            "too long a lease": ({axis.name: slow}, 1.1 * MAX_LEASE_S),
        }
        if driver.robot.axes[axis.name].max_speed is not None:
            requests["too great a speed"] = ({axis.name: 1.01 * axis.speed}, _LEASE_S)
        for description, (velocities, lease_s) in requests.items():
            require_refusal(
                description,
                lambda v=velocities, t=lease_s: driver.move_velocity(v, t),  # type: ignore[misc]
                LimitError,
            )
        subject.require_hold()


@check(needs=VelocityMover)
def velocity_meets_the_limit(bench: DriverBench) -> None:
    """An axis that moves towards an end of its range halts there."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.fastest_axis
        assert isinstance(driver, VelocityMover), "a check runs only if the driver has the ability"
        position = float(subject.read_command()[axis.index])
        end = axis.find_near_end(position)
        # An axis that is already near the end is moved away first.
        if abs(end - position) < 0.05 * axis.span:
            subject.move_by(axis, axis.compute_stroke(position))
            subject.run_until_idle()
            position = float(subject.read_command()[axis.index])
        velocity = float(np.copysign(_SPEED_RATIO * axis.speed, end - position))
        time_s = min(abs(end - position) / abs(velocity) + 0.5, MAX_MOTION_S)
        subject.require_in_range(_run_with_lease(subject, axis, velocity, time_s))
        subject.run_until_idle()
        distance = abs(float(subject.read_command()[axis.index]) - end)
        # A device that brakes early may halt short of the end by its braking distance.
        bound = axis.half_step + axis.compute_braking_distance(velocity)
        require_at_most(f"axis {axis.name} halts short of the end by", distance, bound, axis.unit)
