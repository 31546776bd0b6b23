"""Checks of single moves and of stopping them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

import numpy as np

from rotemina.drivers.abilities import LONGEST_LEASE_S, VelocityMover
from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import CATCH_S, Motion, Subject, interval_of
from rotemina.drivers.conformance.findings import (
    Inapplicable,
    Unmet,
    at_most,
    demand,
    refused,
    within,
)
from rotemina.drivers.errors import LimitError
from rotemina.drivers.gate import Gate, GateError, Permit
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.trajectory.trajectory_excesses import RATE_SLACK

# A stop is asked for between two exchanges with the device: it may take one of them.
STOP_LATE_S = 0.010
# Of a move: gains of amplifiers and sensors are wrong by some percent, units by a factor of 57
# (degrees) or 1000 (millimetres).
_GAIN_ERROR = 0.2
# Of its greatest speed: slow, and still well seen in the time of a check.
_SLOWLY = 0.3
# Of a speed: what a device's own unit of speed may be coarser than ours.
_SPEED_ERROR = 0.05
# Speeds are taken over so long, in which steps and samples weigh little.
_WINDOW_S = 0.05


@check()
def move_arrives(bench: Bench) -> None:
    """A move of several axes arrives, to half a step, and is on its way before."""
    with bench.opened() as subject:
        start = subject.command()
        moved = {subject.slow, subject.quick}
        targets = {
            one: float(start[one.index] + one.stroke(float(start[one.index]))) for one in moved
        }
        subject.driver.move_to({one.name: target for one, target in targets.items()})
        subject.run_while(lambda _: subject.state is DeviceState.IDLE, 0.5 * CATCH_S + 1.0)
        subject.rest()
        end = subject.command()
        for axis in subject.axes:
            expected = targets.get(axis, float(start[axis.index]))
            seen = float(end[axis.index])
            within(f"axis {axis.name} arrives at", seen, expected, axis.half_step, axis.unit)


@check()
def moving_is_said(bench: Bench) -> None:
    """While an axis is on its way the state is moving, and idle afterwards."""
    with bench.opened() as subject:
        subject.cross(subject.slow)
        subject.run(0.1)
        demand(subject.state is DeviceState.MOVING, f"in mid-move it is {subject.state}", "moving")
        subject.stop()
        subject.rest()


@check()
def moves_stay_inside(bench: Bench) -> None:
    """Moves to the nearer ends of all ranges leave no range."""
    with bench.opened() as subject:
        at = subject.command()
        ends = {one.name: one.near_end(float(at[one.index])) for one in subject.axes}
        subject.driver.move_to(ends)
        subject.inside(subject.rest())


@check()
def moves_keep_the_speed(bench: Bench) -> None:
    """No axis is commanded faster than it may go."""
    with bench.opened() as subject:
        axis = subject.slow
        most = subject.driver.robot.axes[axis.name].max_speed
        if most is None:
            raise Inapplicable(f"axis {axis.name} declares no greatest speed")
        subject.cross(axis)
        samples = subject.run(CATCH_S)
        subject.stop()
        elapsed_s = np.diff(samples.device_time_s)
        way = np.abs(np.diff(samples.command[:, axis.index]))
        # Each command is rounded to a step, and the device's time as its clock is.
        elapsed_s += subject.driver.stamp_error_s
        excess = way - axis.resolution - most * elapsed_s * (1.0 + RATE_SLACK) - 1e-9 * axis.span
        worst = int(np.argmax(excess))
        bound = float(way[worst] - excess[worst])
        at_most(f"axis {axis.name} went in one sample", float(way[worst]), bound, axis.unit)


@check()
def move_at_a_speed(bench: Bench) -> None:
    """A move that is given a speed goes no faster, and one of no speed is refused."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        target = axis.far_end(float(subject.command()[axis.index]))
        refused(
            "a move at no speed",
            lambda: driver.move_to({axis.name: target}, {axis.name: 0.0}),
            LimitError,
        )
        speed = _SLOWLY * axis.speed
        driver.move_to({axis.name: target}, {axis.name: speed})
        samples = subject.run(CATCH_S)
        subject.stop()
        bound = speed * (1.0 + _SPEED_ERROR) + axis.resolution / _WINDOW_S
        seen = speed_of(samples, axis)
        at_most(f"told to go slowly, axis {axis.name} goes at", seen, bound, f"{axis.unit}/s")
        demand(seen > 0.0, f"axis {axis.name} stands still", "a slow move")
        subject.rest()


@check()
def new_target(bench: Bench) -> None:
    """A move that is given in mid-move is what counts from then on."""
    with bench.opened() as subject:
        axis = subject.slow
        start = float(subject.command()[axis.index])
        subject.cross(axis)
        subject.run(0.5 * CATCH_S)
        subject.driver.move_to({axis.name: start})
        subject.inside(subject.rest())
        seen = float(subject.command()[axis.index])
        within(
            f"axis {axis.name} was sent back and ends at", seen, start, axis.half_step, axis.unit
        )


@check()
def units(bench: Bench) -> None:
    """Commands and readings are in m and rad: a move of 1 mm is one of 1e-3."""
    with bench.opened() as subject:
        for axis in (subject.slow, subject.quick):
            before = subject.run(0.2)
            way = axis.stroke(float(before.command[-1, axis.index]))
            subject.send(axis, way)
            subject.rest()
            after = subject.run(0.2)
            for name in ("command", "measured"):
                ends = [np.median(getattr(one, name)[:, axis.index]) for one in (before, after)]
                seen = float(ends[1] - ends[0])
                tolerance = _GAIN_ERROR * abs(way) + 2.0 * axis.resolution
                within(f"axis {axis.name}: the {name} changed by", seen, way, tolerance, axis.unit)


@check()
def refused_targets(bench: Bench) -> None:
    """A target beyond a limit, of no axis, or that is no number is refused, and nothing moves."""
    with bench.opened() as subject:
        driver, good, bad = subject.driver, subject.slow, subject.quick
        inside = float(subject.command()[good.index]) + good.stroke(
            float(subject.command()[good.index])
        )
        beyond = bad.high + 0.01 * bad.span
        for what, target in {
            "a target beyond the range": {bad.name: beyond},
            "a target of no axis": {"elbow": 0.0},
            "a target that is no number": {bad.name: float("nan")},
            "an endless target": {bad.name: float("inf")},
        }.items():
            both = target if good is bad else {good.name: inside, **target}
            refused(what, lambda both=both: driver.move_to(both), LimitError)  # type: ignore[misc]
        subject.holds()


@check()
def stop_distance(bench: Bench) -> None:
    """Stopped in mid-move, an axis halts within its stopping distance and time, and holds."""
    with bench.opened() as subject:
        axis = subject.slow
        subject.cross(axis)
        before = subject.run(CATCH_S)
        subject.stop()
        after = subject.rest()
        demand_halt(subject, axis, before, after, late_s=STOP_LATE_S)
        subject.holds()


def demand_halt(
    subject: Subject, axis: Motion, before: Samples, after: Samples, *, late_s: float
) -> None:
    """Demand that an axis that moved ``before`` halts ``after``, as soon as it may and can.

    ``late_s`` is what it may go on for; beside it stand the time between two samples, and how old
    the latest one was.
    """
    slack_s = late_s + subject.late_s + 2.0 * interval_of(before)
    way = float(after.command[-1, axis.index] - before.command[-1, axis.index])
    speed = speed_of(before, axis)
    bound = axis.braking(speed) + speed * slack_s + axis.resolution
    at_most(f"axis {axis.name} went on by", abs(way), bound, axis.unit)
    command = after.command[:, axis.index]
    moving = np.flatnonzero(np.abs(command - command[-1]) > axis.half_step)
    last_s = float(after.device_time_s[moving[-1] + 1]) if len(moving) else 0.0
    took_s = last_s - float(before.device_time_s[-1])
    at_most(f"axis {axis.name} went on for", took_s, speed / axis.acceleration + slack_s, "s")


def speed_of(samples: Samples, axis: Motion) -> float:
    """Return the latest speed of a command, m/s or rad/s, without its sign."""
    time_s = samples.device_time_s
    first = int(np.searchsorted(time_s, time_s[-1] - _WINDOW_S))
    first = min(first, len(time_s) - 2)
    if first < 0:
        raise Unmet(f"{len(time_s)} samples while axis {axis.name} moves; expected: more")
    way = samples.command[-1, axis.index] - samples.command[first, axis.index]
    return float(abs(way) / (time_s[-1] - time_s[first]))


@check()
def stop_when_called(bench: Bench) -> None:
    """A stop takes effect when it is called, not when somebody reads."""
    with bench.opened() as subject:
        if not subject.driver.virtual_time:
            raise Inapplicable("it has no chance to act but when it is read")
        axis = subject.slow
        subject.cross(axis)
        before = subject.run(CATCH_S)
        subject.driver.stop()
        subject.advance(0.5)
        after = subject.driver.read()
        late_s = STOP_LATE_S + 2.0 * interval_of(before)
        soon = after.device_time_s - before.device_time_s[-1] >= late_s
        command = after.command[soon, axis.index]
        speed = abs(command[1] - command[0]) / interval_of(after)
        # It has begun to slow down: how fast that goes is the matter of the stopping distance.
        bound = 0.999 * speed_of(before, axis)
        at_most(
            f"{late_s:.3g} s after a stop axis {axis.name} goes at", speed, bound, f"{axis.unit}/s"
        )
        subject.rest()


@check(moves=False)
def stop_at_rest(bench: Bench) -> None:
    """A stop at rest moves nothing and is no fault."""
    with bench.opened(to_move=False) as subject:
        state = subject.state
        subject.driver.stop()
        subject.holds()
        demand(subject.state is state, f"a stop made it {subject.state}", f"{state} as before")


class _StoppedOnceAsked(Gate):
    """A gate to which a stop comes right after a request has been checked."""

    @contextmanager
    def passing(self, permit: Permit, *, begins: bool) -> Iterator[None]:
        with super().passing(permit, begins=begins):
            yield
        self.stop()


@check()
def stop_overtakes(bench: Bench) -> None:
    """What was checked before a stop does not reach the device after it."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        target = axis.far_end(float(subject.command()[axis.index]))
        requests: list[Callable[[], None]] = [lambda: driver.move_to({axis.name: target})]
        if isinstance(driver, VelocityMover):
            speed = {axis.name: _SLOWLY * axis.speed}
            requests.append(lambda: driver.move_velocity(speed, LONGEST_LEASE_S))
        gate = driver.gate
        for request in requests:
            driver.gate = _StoppedOnceAsked(driver.clock)
            with suppress(GateError):
                request()
            subject.holds()
        driver.gate = gate


@check()
def stop_before_a_move(bench: Bench) -> None:
    """A stop does not undo a move that was asked for after it."""
    with bench.opened() as subject:
        axis = subject.slow
        way = axis.stroke(float(subject.command()[axis.index]))
        subject.driver.stop()
        subject.advance(subject.step_s)
        target = float(subject.command()[axis.index]) + way
        subject.driver.stop()
        subject.advance(subject.step_s)
        subject.driver.move_to({axis.name: target})
        subject.rest()
        seen = float(subject.command()[axis.index])
        within(
            f"moved after a stop, axis {axis.name} ends at", seen, target, axis.half_step, axis.unit
        )
