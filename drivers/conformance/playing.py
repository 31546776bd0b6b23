"""Checks of playing a trajectory."""

import numpy as np

from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import (
    AxisUnderTest,
    DriverUnderTest,
    find_sample_interval,
)
from rotemina.drivers.conformance.findings import (
    RequirementNotMet,
    require_at_most,
    require_refusal,
    require_that,
    require_within,
)
from rotemina.drivers.contract import DeviceSamples, DeviceState, LimitError, StateError
from rotemina.sim.records import Record, Tap

# Fraction of the axis' limits that a trajectory uses, so that no limit interferes.
_EFFORT_RATIO = 0.5
_DURATION_S = 1.0


def _get_player(subject: DriverUnderTest) -> TrajectoryPlayer:
    assert isinstance(subject.driver, TrajectoryPlayer), (
        "a check runs only if the driver has the ability"
    )
    return subject.driver


def _make_test_trajectory(
    subject: DriverUnderTest, axis: AxisUnderTest, start: float, size: float = 1.0
) -> Record:
    """Return a smooth move out and back, ``d/2 (1 − cos 2πt/T)``, with one row per set-point.

    The move starts at ``start``. Its peak speed ``π d/T`` and peak acceleration ``2π² d/T²`` are at
    most ``size`` times half the axis' limits.
    """
    period_s = _get_player(subject).setpoint_period_s
    rows = round(_DURATION_S / period_s)
    time_s = np.linspace(0.0, rows * period_s, rows + 1)
    duration_s = float(time_s[-1])
    distance = min(
        0.1 * axis.span,
        _EFFORT_RATIO * axis.speed * duration_s / np.pi,
        _EFFORT_RATIO * axis.acceleration * duration_s**2 / (2.0 * np.pi**2),
    )
    amplitude = np.copysign(0.5 * distance * size, axis.compute_stroke(start))
    command = start + amplitude * (1.0 - np.cos(2.0 * np.pi * time_s / duration_s))
    return Record.from_signals(
        time_s, {(axis.name, Tap.CMD): np.asarray(command, np.float64)}, {axis.name: axis.unit}
    )


def _read_position(subject: DriverUnderTest, axis: AxisUnderTest) -> float:
    return float(subject.read_command()[axis.index])


@check(needs=TrajectoryPlayer)
def rows_in_order(bench: DriverBench) -> None:
    """Samples give the index of each trajectory row in order, at the time of the row."""
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        trajectory = _make_test_trajectory(subject, axis, _read_position(subject, axis))
        _get_player(subject).play(trajectory)
        samples = subject.run_until_idle()
        has_row = samples.playback_row >= 0
        rows = samples.playback_row[has_row]
        count = len(trajectory.time_s)
        require_that(len(rows) > 0, "no sample names a row", f"{count} rows")
        require_that(bool((np.diff(rows) > 0).all()), "rows are out of order", "ascending rows")
        ends = (int(rows[0]), int(rows[-1]))
        require_that(
            ends == (0, count - 1), f"it played rows {ends[0]} to {ends[1]}", f"0 to {count - 1}"
        )
        interval_s = find_sample_interval(samples)
        # A device that samples at least once per row must name every row.
        if interval_s <= _get_player(subject).setpoint_period_s * (1.0 + 1e-6):
            require_that(len(rows) == count, f"{len(rows)} rows were named", f"all {count}")
        elapsed_s = samples.device_time_s[has_row] - samples.device_time_s[has_row][0]
        max_time_error_s = float(np.abs(elapsed_s - trajectory.time_s[rows]).max())
        require_at_most(
            "a row takes effect too early or too late by", max_time_error_s, interval_s + 1e-6, "s"
        )


@check(needs=TrajectoryPlayer)
def commands_as_told(bench: DriverBench) -> None:
    """The commands of a playback match the trajectory to half a step; other axes hold."""
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        trajectory = _make_test_trajectory(subject, axis, _read_position(subject, axis))
        _get_player(subject).play(trajectory)
        samples = subject.run_until_idle()
        has_row = samples.playback_row >= 0
        expected = trajectory.signal(axis.name, Tap.CMD)[samples.playback_row[has_row]]
        error = float(np.abs(samples.command[has_row, axis.index] - expected).max(initial=0.0))
        require_at_most(
            f"axis {axis.name} is off the trajectory by", error, axis.half_step, axis.unit
        )
        for other in subject.axes:
            if other is not axis:
                travel = float(np.ptp(samples.command[:, other.index]))
                require_at_most(
                    f"axis {other.name} was to hold, but moved by",
                    travel,
                    other.half_step,
                    other.unit,
                )
        progress = subject.driver.status().progress
        require_within("at the end the progress is", progress, 1.0, 1e-9, "")


@check(needs=TrajectoryPlayer)
def refused_trajectories(bench: DriverBench) -> None:
    """A trajectory beyond a limit or of an unknown axis is refused, and nothing moves."""
    with bench.open_driver() as subject:
        axis, player = subject.slowest_axis, _get_player(subject)
        start = _read_position(subject, axis)
        outside = _make_test_trajectory(subject, axis, axis.high + 0.01 * axis.span)
        require_refusal("a trajectory outside the range", lambda: player.play(outside), LimitError)
        if player.robot.axes[axis.name].max_speed is not None:
            too_fast = _make_test_trajectory(subject, axis, start, size=1.1 / _EFFORT_RATIO**2)
            require_refusal("too fast a trajectory", lambda: player.play(too_fast), LimitError)
        accepted = _make_test_trajectory(subject, axis, start)
        values = accepted.signal(axis.name, Tap.CMD)
        unknown_axis = Record.from_signals(
            accepted.time_s, {("elbow", Tap.CMD): values}, {"elbow": "m"}
        )
        require_refusal(
            "a trajectory of an unknown axis", lambda: player.play(unknown_axis), LimitError
        )
        require_that(subject.state is DeviceState.IDLE, f"it is {subject.state}", "idle")
        subject.require_hold()


@check(needs=TrajectoryPlayer)
def one_owner(bench: DriverBench) -> None:
    """A trajectory is refused during a move, and moves and trajectories during a playback."""
    with bench.open_driver() as subject:
        axis, player = subject.slowest_axis, _get_player(subject)
        start = _read_position(subject, axis)
        trajectory = _make_test_trajectory(subject, axis, start)
        subject.move_to_far_end(axis)
        subject.run(0.1)
        require_refusal("a trajectory during a move", lambda: player.play(trajectory), StateError)
        subject.stop()
        subject.run_until_idle()
        player.play(_make_test_trajectory(subject, axis, _read_position(subject, axis)))
        subject.run(0.1)
        require_refusal("a second trajectory", lambda: player.play(trajectory), StateError)
        require_refusal(
            "a move during a playback", lambda: player.move_to({axis.name: start}), StateError
        )
        subject.stop()
        subject.run_until_idle()


@check(needs=TrajectoryPlayer)
def stop_in_every_phase(bench: DriverBench) -> None:
    """A stop ends a playback on the way to the first row, at the first row, and between rows."""
    for phase in ("on the way to the first row", "at the first row", "among the rows"):
        with bench.open_driver() as subject:
            axis, player = subject.slowest_axis, _get_player(subject)
            start = _read_position(subject, axis) + axis.compute_stroke(
                _read_position(subject, axis)
            )
            player.play(_make_test_trajectory(subject, axis, start))
            subject.run(0.1)
            if not _run_to_phase(subject, axis, start, phase):
                # A device without a settling time starts the rows at once.
                continue
            subject.stop()
            subject.run_until_idle()
            after = subject.run(1.0)
            travel = float(np.ptp(after.command[:, axis.index]))
            require_at_most(
                f"stopped {phase}, axis {axis.name} moved", travel, axis.half_step, axis.unit
            )
            row = int(after.playback_row.max())
            require_that(row == -1, f"stopped {phase}, it names row {row}", "no more rows")
            progress = player.status().progress
            require_that(
                progress < 1.0, f"stopped {phase}, the progress is {progress:g}", "less than 1"
            )
            player.move_to({axis.name: start})
            subject.run_until_idle()


def _run_to_phase(subject: DriverUnderTest, axis: AxisUnderTest, start: float, phase: str) -> bool:
    """Let time pass until a playback reaches a phase; return whether the phase exists."""
    if phase == "on the way to the first row":
        return True

    def is_on_the_way(latest: DeviceSamples) -> bool:
        return not len(latest) or (
            abs(float(latest.command[-1, axis.index]) - start) > axis.half_step
            and latest.playback_row.max() < 0
        )

    def is_before_first_row(latest: DeviceSamples) -> bool:
        return not len(latest) or int(latest.playback_row.max()) < 0

    samples = subject.run_while(is_on_the_way)
    if phase == "at the first row":
        return int(samples.playback_row.max()) < 0
    subject.run_while(is_before_first_row)
    subject.run(0.3 * _DURATION_S)
    if subject.state is DeviceState.IDLE:
        raise RequirementNotMet(
            "a trajectory ended in a third of its time; expected: it still plays"
        )
    return True
