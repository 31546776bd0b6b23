"""Checks of playing a trajectory."""

import numpy as np

from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import Motion, Subject, interval_of
from rotemina.drivers.conformance.findings import Unmet, at_most, demand, refused, within
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.records.record import Record, Tap

# Half of what the axis may: the check is about playing, not about limits.
_EFFORT = 0.5
_DURATION_S = 1.0


def _player(subject: Subject) -> TrajectoryPlayer:
    assert isinstance(subject.driver, TrajectoryPlayer), "a check runs where its ability is"
    return subject.driver


def _bow(subject: Subject, axis: Motion, first: float, size: float = 1.0) -> Record:
    """Return a smooth way there and back, ``d/2 (1 − cos 2πt/T)``, one row each set-point period.

    Speed ``π d/T`` and acceleration ``2π² d/T²`` are half of what the axis may, times ``size``.
    """
    period_s = _player(subject).setpoint_period_s
    rows = round(_DURATION_S / period_s)
    time_s = np.linspace(0.0, rows * period_s, rows + 1)
    length_s = float(time_s[-1])
    distance = min(
        0.1 * axis.span,
        _EFFORT * axis.speed * length_s / np.pi,
        _EFFORT * axis.acceleration * length_s**2 / (2.0 * np.pi**2),
    )
    way = np.copysign(0.5 * distance * size, axis.stroke(first))
    command = first + way * (1.0 - np.cos(2.0 * np.pi * time_s / length_s))
    return Record.from_signals(
        time_s, {(axis.name, Tap.CMD): np.asarray(command, np.float64)}, {axis.name: axis.unit}
    )


def _at(subject: Subject, axis: Motion) -> float:
    return float(subject.command()[axis.index])


@check(needs=TrajectoryPlayer)
def rows_in_order(bench: Bench) -> None:
    """Its samples name the rows of a trajectory in order, from the first to the last, in time."""
    with bench.opened() as subject:
        axis = subject.slow
        trajectory = _bow(subject, axis, _at(subject, axis))
        _player(subject).play(trajectory)
        samples = subject.rest()
        own = samples.playback_row >= 0
        rows = samples.playback_row[own]
        count = len(trajectory.time_s)
        demand(len(rows) > 0, "no sample names a row", f"{count} rows")
        demand(bool((np.diff(rows) > 0).all()), "rows are named out of order", "ascending rows")
        ends = (int(rows[0]), int(rows[-1]))
        demand(
            ends == (0, count - 1), f"it played rows {ends[0]} to {ends[1]}", f"0 to {count - 1}"
        )
        sampled_s = interval_of(samples)
        # A device that samples as often as rows come leaves out none of them.
        if sampled_s <= _player(subject).setpoint_period_s * (1.0 + 1e-6):
            demand(len(rows) == count, f"{len(rows)} rows were named", f"all {count}")
        since = samples.device_time_s[own] - samples.device_time_s[own][0]
        late_s = float(np.abs(since - trajectory.time_s[rows]).max())
        at_most("a row acts off its time by", late_s, sampled_s + 1e-6, "s")


@check(needs=TrajectoryPlayer)
def commands_as_told(bench: Bench) -> None:
    """The commands of a playback are the trajectory's to half a step; other axes hold."""
    with bench.opened() as subject:
        axis = subject.slow
        trajectory = _bow(subject, axis, _at(subject, axis))
        _player(subject).play(trajectory)
        samples = subject.rest()
        own = samples.playback_row >= 0
        told = trajectory.signal(axis.name, Tap.CMD)[samples.playback_row[own]]
        off = float(np.abs(samples.command[own, axis.index] - told).max(initial=0.0))
        at_most(f"axis {axis.name} is off the trajectory by", off, axis.half_step, axis.unit)
        for other in subject.axes:
            if other is not axis:
                moved = float(np.ptp(samples.command[:, other.index]))
                at_most(
                    f"axis {other.name} was to hold, and moved", moved, other.half_step, other.unit
                )
        progress = subject.driver.status().progress
        within("at the end the progress is", progress, 1.0, 1e-9, "")


@check(needs=TrajectoryPlayer)
def refused_trajectories(bench: Bench) -> None:
    """A trajectory beyond a limit, or of no axis, is refused, and nothing moves."""
    with bench.opened() as subject:
        axis, player = subject.slow, _player(subject)
        start = _at(subject, axis)
        outside = _bow(subject, axis, axis.high + 0.01 * axis.span)
        refused("a trajectory outside the range", lambda: player.play(outside), LimitError)
        if player.robot.axes[axis.name].max_speed is not None:
            hasty = _bow(subject, axis, start, size=1.1 / _EFFORT**2)
            refused("too fast a trajectory", lambda: player.play(hasty), LimitError)
        good = _bow(subject, axis, start)
        values = good.signal(axis.name, Tap.CMD)
        elbow = Record.from_signals(good.time_s, {("elbow", Tap.CMD): values}, {"elbow": "m"})
        refused("a trajectory of no axis", lambda: player.play(elbow), LimitError)
        demand(subject.state is DeviceState.IDLE, f"it is {subject.state}", "idle")
        subject.holds()


@check(needs=TrajectoryPlayer)
def one_owner(bench: Bench) -> None:
    """What moves plays no trajectory, and what plays one neither moves nor plays another."""
    with bench.opened() as subject:
        axis, player = subject.slow, _player(subject)
        start = _at(subject, axis)
        trajectory = _bow(subject, axis, start)
        subject.cross(axis)
        subject.run(0.1)
        refused("a trajectory in mid-move", lambda: player.play(trajectory), StateError)
        subject.stop()
        subject.rest()
        player.play(_bow(subject, axis, _at(subject, axis)))
        subject.run(0.1)
        refused("a second trajectory", lambda: player.play(trajectory), StateError)
        refused("a move in a playback", lambda: player.move_to({axis.name: start}), StateError)
        subject.stop()
        subject.rest()


@check(needs=TrajectoryPlayer)
def stop_in_every_phase(bench: Bench) -> None:
    """A stop ends a trajectory on the way to its first row, at it, and while rows are played."""
    for phase in ("on the way to the first row", "at the first row", "among the rows"):
        with bench.opened() as subject:
            axis, player = subject.slow, _player(subject)
            first = _at(subject, axis) + axis.stroke(_at(subject, axis))
            player.play(_bow(subject, axis, first))
            subject.run(0.1)
            if not _reached(subject, axis, first, phase):
                continue  # a device that does not settle begins with its rows at once
            subject.stop()
            subject.rest()
            after = subject.run(1.0)
            moved = float(np.ptp(after.command[:, axis.index]))
            at_most(f"stopped {phase}, axis {axis.name} moved", moved, axis.half_step, axis.unit)
            named = int(after.playback_row.max())
            demand(named == -1, f"stopped {phase}, it names row {named}", "no more rows")
            progress = player.status().progress
            demand(progress < 1.0, f"stopped {phase}, the progress is {progress:g}", "less than 1")
            player.move_to({axis.name: first})
            subject.rest()


def _reached(subject: Subject, axis: Motion, first: float, phase: str) -> bool:
    """Let time pass until a playback is in a phase; return whether it ever is."""
    if phase == "on the way to the first row":
        return True

    def on_the_way(latest: Samples) -> bool:
        return not len(latest) or (
            abs(float(latest.command[-1, axis.index]) - first) > axis.half_step
            and latest.playback_row.max() < 0
        )

    def settling(latest: Samples) -> bool:
        return not len(latest) or int(latest.playback_row.max()) < 0

    samples = subject.run_while(on_the_way)
    if phase == "at the first row":
        return int(samples.playback_row.max()) < 0
    subject.run_while(settling)
    subject.run(0.3 * _DURATION_S)
    if subject.state is DeviceState.IDLE:
        raise Unmet("a trajectory ended before a third of its time; expected: it still plays")
    return True
