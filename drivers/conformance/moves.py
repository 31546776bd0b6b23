"""Checks of single moves and of stopping them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

import numpy as np

from rotemina.drivers.abilities import MAX_LEASE_S, VelocityMover
from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import (
    STROKE_S,
    AxisUnderTest,
    DriverUnderTest,
    find_sample_interval,
)
from rotemina.drivers.conformance.findings import (
    CheckNotApplicable,
    RequirementNotMet,
    require_at_most,
    require_refusal,
    require_that,
    require_within,
)
from rotemina.drivers.contract import (
    DeviceSamples,
    DeviceState,
    Gate,
    GateError,
    LimitError,
    Permit,
)
from rotemina.sim.trajectory import RATE_SLACK_RATIO

# A stop is sent between two exchanges with the device, and may have to wait for one of them.
MAX_STOP_DELAY_S = 0.010
# Field of the samples, and what a finding calls it.
_SIGNAL_NAMES = {"command": "the command", "measured": "the reading"}
# Relative tolerance of a distance. Gain errors of amplifiers and sensors are a few percent, but
# wrong units change a distance by a factor of 57 (degrees) or 1000 (millimetres).
_GAIN_TOLERANCE = 0.2
# Fraction of full speed: slow, but fast enough for a check to see the motion.
_SLOW_SPEED_RATIO = 0.3
# Relative tolerance of a speed, because the device's unit of speed may be coarse.
_SPEED_TOLERANCE = 0.05
# Speeds are averaged over this time, so that single steps and samples matter little.
_SPEED_WINDOW_S = 0.05


@check()
def move_arrives(bench: DriverBench) -> None:
    """A move of several axes arrives to within half a step."""
    with bench.open_driver() as subject:
        start = subject.read_command()
        moving_axes = {subject.slowest_axis, subject.fastest_axis}
        targets = {
            axis: float(start[axis.index] + axis.compute_stroke(float(start[axis.index])))
            for axis in moving_axes
        }
        subject.driver.move_to({axis.name: target for axis, target in targets.items()})
        subject.run_while(lambda _: subject.state is DeviceState.IDLE, 0.5 * STROKE_S + 1.0)
        subject.run_until_idle()
        end = subject.read_command()
        for axis in subject.axes:
            expected = targets.get(axis, float(start[axis.index]))
            actual = float(end[axis.index])
            require_within(
                f"axis {axis.name} arrives at", actual, expected, axis.half_step, axis.unit
            )


@check()
def moving_is_said(bench: DriverBench) -> None:
    """The state is moving during a move, and idle afterwards."""
    with bench.open_driver() as subject:
        subject.move_to_far_end(subject.slowest_axis)
        subject.run(0.1)
        require_that(
            subject.state is DeviceState.MOVING, f"during a move it is {subject.state}", "moving"
        )
        subject.stop()
        subject.run_until_idle()


@check()
def moves_stay_inside(bench: DriverBench) -> None:
    """Moves to the nearer ends of all ranges stay inside the ranges."""
    with bench.open_driver() as subject:
        start = subject.read_command()
        ends = {axis.name: axis.find_near_end(float(start[axis.index])) for axis in subject.axes}
        subject.driver.move_to(ends)
        subject.require_in_range(subject.run_until_idle())


@check()
def moves_keep_the_speed(bench: DriverBench) -> None:
    """No axis is commanded to exceed its maximum speed."""
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        max_speed = subject.driver.robot.axes[axis.name].max_speed
        if max_speed is None:
            raise CheckNotApplicable(f"axis {axis.name} has no speed limit in the robot file")
        subject.move_to_far_end(axis)
        samples = subject.run(STROKE_S)
        subject.stop()
        elapsed_s = np.diff(samples.device_time_s)
        distance = np.abs(np.diff(samples.command[:, axis.index]))
        # Commands are rounded to a step, and times to the resolution of the device's clock.
        elapsed_s += subject.driver.stamp_error_s
        excess = (
            distance
            - axis.resolution
            - max_speed * elapsed_s * (1.0 + RATE_SLACK_RATIO)
            - 1e-9 * axis.span
        )
        worst = int(np.argmax(excess))
        bound = float(distance[worst] - excess[worst])
        require_at_most(
            f"axis {axis.name} moved in one sample by", float(distance[worst]), bound, axis.unit
        )


@check()
def move_at_a_speed(bench: DriverBench) -> None:
    """A move with a speed limit does not exceed it, and a move with a limit of zero is refused."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        target = axis.find_far_end(float(subject.read_command()[axis.index]))
        require_refusal(
            "a move at a speed of zero",
            lambda: driver.move_to({axis.name: target}, {axis.name: 0.0}),
            LimitError,
        )
        speed = _SLOW_SPEED_RATIO * axis.speed
        driver.move_to({axis.name: target}, {axis.name: speed})
        samples = subject.run(STROKE_S)
        subject.stop()
        bound = speed * (1.0 + _SPEED_TOLERANCE) + axis.resolution / _SPEED_WINDOW_S
        actual = find_latest_speed(samples, axis)
        require_at_most(
            f"in a slow move axis {axis.name} moves at", actual, bound, f"{axis.unit}/s"
        )
        require_that(actual > 0.0, f"axis {axis.name} does not move", "a slow move")
        subject.run_until_idle()


@check()
def new_target(bench: DriverBench) -> None:
    """A move that is requested during another move replaces it."""
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        start = float(subject.read_command()[axis.index])
        subject.move_to_far_end(axis)
        subject.run(0.5 * STROKE_S)
        subject.driver.move_to({axis.name: start})
        subject.require_in_range(subject.run_until_idle())
        actual = float(subject.read_command()[axis.index])
        require_within(
            f"axis {axis.name} was sent back and ends at", actual, start, axis.half_step, axis.unit
        )


@check()
def units(bench: DriverBench) -> None:
    """Commands and readings are in m and rad: a move of 1 mm changes both by 1e-3."""
    with bench.open_driver() as subject:
        for axis in (subject.slowest_axis, subject.fastest_axis):
            before = subject.run(0.2)
            distance = axis.compute_stroke(float(before.command[-1, axis.index]))
            subject.move_by(axis, distance)
            subject.run_until_idle()
            after = subject.run(0.2)
            for name in _SIGNAL_NAMES:
                ends = [
                    np.median(getattr(samples, name)[:, axis.index]) for samples in (before, after)
                ]
                actual = float(ends[1] - ends[0])
                tolerance = _GAIN_TOLERANCE * abs(distance) + 2.0 * axis.resolution
                require_within(
                    f"axis {axis.name}: {_SIGNAL_NAMES[name]} changed by",
                    actual,
                    distance,
                    tolerance,
                    axis.unit,
                )


@check()
def refused_targets(bench: DriverBench) -> None:
    """A target is refused if it is out of range, of an unknown axis, or not a number."""
    with bench.open_driver() as subject:
        driver, valid_axis, refused_axis = (
            subject.driver,
            subject.slowest_axis,
            subject.fastest_axis,
        )
        inside = float(subject.read_command()[valid_axis.index]) + valid_axis.compute_stroke(
            float(subject.read_command()[valid_axis.index])
        )
        beyond = refused_axis.high + 0.01 * refused_axis.span
        for description, target in {
            "a target beyond the range": {refused_axis.name: beyond},
            "a target of an unknown axis": {"elbow": 0.0},
            "a target that is not a number": {refused_axis.name: float("nan")},
            "an infinite target": {refused_axis.name: float("inf")},
        }.items():
            targets = target if valid_axis is refused_axis else {valid_axis.name: inside, **target}
            require_refusal(
                description,
                lambda targets=targets: driver.move_to(targets),  # type: ignore[misc]
                LimitError,
            )
        subject.require_hold()


@check()
def stop_distance(bench: DriverBench) -> None:
    """An axis that is stopped during a move halts within its stopping distance and time."""
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        subject.move_to_far_end(axis)
        before = subject.run(STROKE_S)
        subject.stop()
        after = subject.run_until_idle()
        require_halt(subject, axis, before, after, max_delay_s=MAX_STOP_DELAY_S)
        subject.require_hold()


def require_halt(
    subject: DriverUnderTest,
    axis: AxisUnderTest,
    before: DeviceSamples,
    after: DeviceSamples,
    *,
    max_delay_s: float,
) -> None:
    """Require that an axis that moved in ``before`` halts in ``after`` as soon as possible.

    Before it brakes, the axis may continue for ``max_delay_s``, plus the age of the latest sample
    and twice the time between samples.
    """
    slack_s = max_delay_s + subject.max_sample_age_s + 2.0 * find_sample_interval(before)
    distance = float(after.command[-1, axis.index] - before.command[-1, axis.index])
    speed = find_latest_speed(before, axis)
    bound = axis.compute_braking_distance(speed) + speed * slack_s + axis.resolution
    require_at_most(f"after a stop axis {axis.name} moved on by", abs(distance), bound, axis.unit)
    command = after.command[:, axis.index]
    moving = np.flatnonzero(np.abs(command - command[-1]) > axis.half_step)
    halt_s = float(after.device_time_s[moving[-1] + 1]) if len(moving) else 0.0
    duration_s = halt_s - float(before.device_time_s[-1])
    require_at_most(
        f"after a stop axis {axis.name} moved on for",
        duration_s,
        speed / axis.acceleration + slack_s,
        "s",
    )


def find_latest_speed(samples: DeviceSamples, axis: AxisUnderTest) -> float:
    """Return the magnitude of the commanded speed at the end of the samples, m/s or rad/s."""
    time_s = samples.device_time_s
    first_index = int(np.searchsorted(time_s, time_s[-1] - _SPEED_WINDOW_S))
    first_index = min(first_index, len(time_s) - 2)
    if first_index < 0:
        raise RequirementNotMet(
            f"{len(time_s)} samples while axis {axis.name} moves; expected: more"
        )
    distance = samples.command[-1, axis.index] - samples.command[first_index, axis.index]
    return float(abs(distance) / (time_s[-1] - time_s[first_index]))


@check()
def stop_when_called(bench: DriverBench) -> None:
    """A stop takes effect when it is called, not at the next read."""
    with bench.open_driver() as subject:
        if not subject.driver.virtual_time:
            raise CheckNotApplicable("it can act only when it is read")
        axis = subject.slowest_axis
        subject.move_to_far_end(axis)
        before = subject.run(STROKE_S)
        subject.driver.stop()
        subject.advance(0.5)
        after = subject.driver.read()
        delay_s = MAX_STOP_DELAY_S + 2.0 * find_sample_interval(before)
        is_after_delay = after.device_time_s - before.device_time_s[-1] >= delay_s
        command = after.command[is_after_delay, axis.index]
        speed = abs(command[1] - command[0]) / find_sample_interval(after)
        # The axis must have begun to slow down. Another check covers the stopping distance.
        bound = 0.999 * find_latest_speed(before, axis)
        require_at_most(
            f"{delay_s:.3g} s after a stop axis {axis.name} moves at",
            speed,
            bound,
            f"{axis.unit}/s",
        )
        subject.run_until_idle()


@check(moves=False)
def stop_at_rest(bench: DriverBench) -> None:
    """A stop at rest causes neither motion nor a fault."""
    with bench.open_driver(to_move=False) as subject:
        state = subject.state
        subject.driver.stop()
        subject.require_hold()
        require_that(
            subject.state is state, f"after a stop it is {subject.state}", f"{state} as before"
        )


class _StopAfterCheckGate(Gate):
    @contextmanager
    def passing(self, permit: Permit, *, begins: bool) -> Iterator[None]:
        with super().passing(permit, begins=begins):
            yield
        self.stop()


@check()
def stop_overtakes(bench: DriverBench) -> None:
    """A request that was checked before a stop does not reach the device after the stop."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        target = axis.find_far_end(float(subject.read_command()[axis.index]))
        requests: list[Callable[[], None]] = [lambda: driver.move_to({axis.name: target})]
        if isinstance(driver, VelocityMover):
            speed = {axis.name: _SLOW_SPEED_RATIO * axis.speed}
            requests.append(lambda: driver.move_velocity(speed, MAX_LEASE_S))
        gate = driver.gate
        for request in requests:
            driver.gate = _StopAfterCheckGate(driver.clock)
            with suppress(GateError):
                request()
            subject.require_hold()
        driver.gate = gate


@check()
def stop_before_a_move(bench: DriverBench) -> None:
    """A stop does not cancel a move that was requested after it."""
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        distance = axis.compute_stroke(float(subject.read_command()[axis.index]))
        subject.driver.stop()
        subject.advance(subject.step_s)
        target = float(subject.read_command()[axis.index]) + distance
        subject.driver.stop()
        subject.advance(subject.step_s)
        subject.driver.move_to({axis.name: target})
        subject.run_until_idle()
        actual = float(subject.read_command()[axis.index])
        require_within(
            f"after a stop and a move axis {axis.name} ends at",
            actual,
            target,
            axis.half_step,
            axis.unit,
        )
