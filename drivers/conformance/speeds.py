"""Checks of motion at a speed, for the duration of its lease."""

import numpy as np

from rotemina.drivers.abilities import LONGEST_LEASE_S, VelocityMover
from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import LONGEST_S, Motion, Subject, interval_of
from rotemina.drivers.conformance.findings import at_most, demand, refused
from rotemina.drivers.conformance.moves import STOP_LATE_S, demand_halt
from rotemina.drivers.errors import LimitError
from rotemina.drivers.samples import DeviceState, Samples

# Half its greatest speed: room on both sides for a driver that does something else.
_SHARE = 0.5
_LEASE_S = 0.2
# A device may look at leases at a tick of its own; a fiftieth of a second is as soon as it must.
_LEASE_LATE_S = 0.020
# Of a speed: what a device's own unit of speed may be coarser than ours.
_SPEED_ERROR = 0.05


def _sped(subject: Subject, axis: Motion) -> float:
    """Return half the greatest speed, m/s or rad/s, towards the farther end of the range."""
    at = float(subject.command()[axis.index])
    return float(np.copysign(_SHARE * axis.speed, axis.far_end(at) - at))


def _renewed(subject: Subject, axis: Motion, velocity: float, seconds: float) -> Samples:
    """Keep an axis going, its lease renewed at half of its time; return what was sampled."""
    driver = subject.driver
    assert isinstance(driver, VelocityMover), "a check runs where its ability is"
    parts = []
    for _ in range(round(seconds / (0.5 * _LEASE_S))):
        driver.move_velocity({axis.name: velocity}, _LEASE_S)
        parts.append(subject.run(0.5 * _LEASE_S))
    return Samples.joined(parts, len(subject.axes))


@check(needs=VelocityMover)
def lease_expiry(bench: Bench) -> None:
    """An axis whose lease runs out halts by itself, within its deceleration, without a fault."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        assert isinstance(driver, VelocityMover), "a check runs where its ability is"
        velocity = _sped(subject, axis)
        begun_s = float(subject.run_while(lambda one: len(one) == 0, 5.0).device_time_s[-1])
        driver.move_velocity({axis.name: velocity}, _LEASE_S)
        samples = subject.run(3.0 * _LEASE_S + abs(velocity) / axis.acceleration)
        moving = np.flatnonzero(np.abs(np.diff(samples.command[:, axis.index])) > axis.half_step)
        demand(len(moving) > 0, f"axis {axis.name} did not move at a speed", "motion")
        took_s = float(samples.device_time_s[moving[-1] + 1]) - begun_s
        slack_s = _LEASE_LATE_S + subject.late_s + 2.0 * interval_of(samples)
        bound_s = _LEASE_S + abs(velocity) / axis.acceleration + slack_s
        at_most(f"with a lease of {_LEASE_S:g} s axis {axis.name} moved for", took_s, bound_s, "s")
        status = driver.status()
        demand(status.state is DeviceState.IDLE, f"it is {status.state} ({status.fault})", "idle")
        subject.holds()


@check(needs=VelocityMover)
def lease_renewed(bench: Bench) -> None:
    """A lease that is renewed before its end goes on at the same speed, without a jump."""
    with bench.opened() as subject:
        axis = subject.slow
        velocity = _sped(subject, axis)
        _renewed(subject, axis, velocity, abs(velocity) / axis.acceleration + _LEASE_S)
        samples = _renewed(subject, axis, velocity, 0.6)
        subject.stop()
        way = np.diff(samples.command[:, axis.index])
        expected = velocity * np.diff(samples.device_time_s)
        off = np.abs(way - expected) - _SPEED_ERROR * np.abs(expected)
        worst = int(np.argmax(off))
        at_most(
            f"at {abs(velocity):.3g} {axis.unit}/s axis {axis.name} is off in one sample by",
            float(off[worst]),
            axis.resolution + 1e-9 * axis.span,
            axis.unit,
        )
        subject.rest()


@check(needs=VelocityMover)
def zero_velocity(bench: Bench) -> None:
    """A speed of zero halts an axis within its stopping distance, lease or not."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        assert isinstance(driver, VelocityMover), "a check runs where its ability is"
        before = _renewed(subject, axis, _sped(subject, axis), 0.3)
        driver.move_velocity({axis.name: 0.0}, LONGEST_LEASE_S)
        after = subject.rest()
        demand_halt(subject, axis, before, after, late_s=STOP_LATE_S)
        subject.holds()


@check(needs=VelocityMover)
def stop_ends_leases(bench: Bench) -> None:
    """A stop halts an axis that moves at a speed, however long its lease goes on."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        assert isinstance(driver, VelocityMover), "a check runs where its ability is"
        driver.move_velocity({axis.name: _sped(subject, axis)}, LONGEST_LEASE_S)
        before = subject.run(0.3)
        subject.stop()
        after = subject.rest()
        demand_halt(subject, axis, before, after, late_s=STOP_LATE_S)
        subject.holds()


@check(needs=VelocityMover)
def refused_velocities(bench: Bench) -> None:
    """Speeds that an axis may not go, and leases of no time or too long, are refused."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        assert isinstance(driver, VelocityMover), "a check runs where its ability is"
        slow = 0.1 * axis.speed
        asked = {
            "a speed that is no number": ({axis.name: float("nan")}, _LEASE_S),
            "a speed of no axis": ({axis.name: slow, "elbow": 0.0}, _LEASE_S),
            "a lease of no time": ({axis.name: slow}, 0.0),
            "too long a lease": ({axis.name: slow}, 1.1 * LONGEST_LEASE_S),
        }
        if driver.robot.axes[axis.name].max_speed is not None:
            asked["too great a speed"] = ({axis.name: 1.01 * axis.speed}, _LEASE_S)
        for what, (velocities, lease_s) in asked.items():
            refused(
                what,
                lambda v=velocities, t=lease_s: driver.move_velocity(v, t),  # type: ignore[misc]
                LimitError,
            )
        subject.holds()


@check(needs=VelocityMover)
def velocity_meets_the_limit(bench: Bench) -> None:
    """An axis that is driven towards an end of its range halts there, and does not leave it."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.quick
        assert isinstance(driver, VelocityMover), "a check runs where its ability is"
        at = float(subject.command()[axis.index])
        end = axis.near_end(at)
        if abs(end - at) < 0.05 * axis.span:  # it is there already: come from farther away
            subject.send(axis, axis.stroke(at))
            subject.rest()
            at = float(subject.command()[axis.index])
        velocity = float(np.copysign(_SHARE * axis.speed, end - at))
        time_s = min(abs(end - at) / abs(velocity) + 0.5, LONGEST_S)
        subject.inside(_renewed(subject, axis, velocity, time_s))
        subject.rest()
        short = abs(float(subject.command()[axis.index]) - end)
        # A device that brakes before it must may stand short of the end by as much.
        bound = axis.half_step + axis.braking(velocity)
        at_most(f"axis {axis.name} stands short of the end by", short, bound, axis.unit)
