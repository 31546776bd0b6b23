"""A dry run: what a trajectory asks of a machine, and how well the model expects it to follow."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import AxisName, Listed, Message, lines, message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, Robot
from rotemina.sim.trajectory.axis_limits import (
    OutOfLimitsError,
    resolution_of,
    voltage_bounds,
)
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory
from rotemina.sim.trajectory.prediction import TrackingError, predict
from rotemina.sim.trajectory.speed_and_acceleration import (
    SETPOINT_PERIOD_S,
    accelerations,
    jump_speeds,
)
from rotemina.sim.trajectory.trajectory_excesses import Violation, find_violations


class Bounds(NamedTuple):
    """What limits an axis: m or rad, per s, per s², V; None where nothing is declared."""

    range: tuple[float, float]
    max_speed: float | None
    max_acceleration: float | None
    voltage_range: tuple[float, float] | None


@dataclass(frozen=True, slots=True)
class AxisFigures:
    """The demands of a trajectory on one axis, in ``unit`` (m or rad), per s and per s².

    ``peak_speed`` is that of the jumps from row to row as a device makes them,
    ``peak_acceleration`` is taken over the window in which rounding weighs little, so both are
    large where rows are farther apart than set-points. ``tracking_rms`` and ``tracking_peak``
    compare the position that the nominal model predicts with the command at each row; None where
    the model gives none.
    """

    unit: str
    start: float
    end: float
    lowest: float
    highest: float
    peak_speed: float
    peak_acceleration: float
    bounds: Bounds
    tracking_rms: float | None
    tracking_peak: float | None


@dataclass(frozen=True, slots=True)
class DryRun:
    """Figures of each axis, in the trajectory's order, and the limits that it would break.

    ``violations`` come with what the model predicts: an axis that swings out of its range.
    ``prediction_fault`` says why there is no prediction, where there is none. ``checked`` is what
    to play, where it may be played.
    """

    duration_s: float
    rows: int
    axes: Mapping[str, AxisFigures]
    violations: tuple[Violation, ...]
    prediction_fault: str | None = None
    checked: CheckedTrajectory | None = None

    @property
    def objections(self) -> tuple[Message, ...]:
        """Why the machine must not play the trajectory; none where it may."""
        found = tuple(violation.message for violation in self.violations)
        if self.prediction_fault is None:
            return found
        unknown = message("engine", "the model cannot predict its motion: {fault}")
        return (*found, unknown.fill(fault=self.prediction_fault))

    @property
    def moved_axes(self) -> tuple[str, ...]:
        """The axes that do not stay where they begin."""
        return tuple(name for name, axis in self.axes.items() if axis.highest > axis.lowest)

    @property
    def axes_without_limit(self) -> tuple[str, ...]:
        """The axes that move, but whose speed or acceleration nothing limits."""
        bounds = {axis: self.axes[axis].bounds for axis in self.moved_axes}
        return tuple(
            axis
            for axis, one in bounds.items()
            if one.max_speed is None or one.max_acceleration is None
        )

    @property
    def verdict(self) -> Message:
        """What was checked, and which limits are missing, where the machine may play."""
        speed, acceleration = message("engine", "the speed"), message("engine", "the acceleration")
        checked: list[Message] = [message("engine", "the range")]
        missing: list[Message] = []
        bounds = {axis: self.axes[axis].bounds for axis in self.moved_axes}
        if any(one.voltage_range is not None for one in bounds.values()):
            checked.append(message("engine", "the voltage"))
        for quantity, limits in (
            (speed, {axis: one.max_speed for axis, one in bounds.items()}),
            (acceleration, {axis: one.max_acceleration for axis, one in bounds.items()}),
        ):
            for into, is_missing in ((checked, False), (missing, True)):
                axes = [
                    AxisName(axis) for axis, most in limits.items() if (most is None) is is_missing
                ]
                if axes:
                    said = message("engine", "{quantity} of {axes}")
                    into.append(said.fill(quantity=quantity, axes=Listed(tuple(axes))))
        if not missing:
            return message("engine", "within the limits")
        return message("engine", "inside {checked}; no limit is stated for {missing}").fill(
            checked=Listed(tuple(checked)), missing=Listed(tuple(missing))
        )

    @property
    def allowed(self) -> bool:
        """Whether the machine may play the trajectory."""
        return self.checked is not None

    def require(self) -> CheckedTrajectory:
        """Return what to play.

        Raises
        ------
        OutOfLimitsError
            With all objections, if the machine must not play it.
        """
        if self.checked is None:
            raise OutOfLimitsError(lines(self.objections))
        return self.checked


def dry_run(
    robot: Robot,
    trajectory: Record,
    *,
    setpoint_period_s: float = SETPOINT_PERIOD_S,
    corrected: Robot | None = None,
) -> DryRun:
    """Examine a trajectory without moving anything.

    ``setpoint_period_s`` is that of the device that shall play it. ``corrected`` is the same robot
    with what a diagnosis found: its tracking errors are told. What may be played does not depend
    on it.

    Raises
    ------
    TrajectoryError
        If the trajectory is not one for this robot: an axis that it lacks, the wrong quantity, a
        force that no controller holds.
    """
    sealed = CheckedTrajectory.sealed(robot, trajectory, setpoint_period_s)
    commands = sealed.commands
    violations = find_violations(robot, commands, setpoint_period_s=setpoint_period_s)
    prediction = predict(robot, commands, setpoint_period_s)
    violations += prediction.violations
    if corrected is not None:
        told = predict(corrected, commands, setpoint_period_s)
        prediction = replace(prediction, errors=told.errors)
    figures = {
        name: _figures(robot.axes[name], commands, name, setpoint_period_s, prediction.errors)
        for name in commands.axes
    }
    sound = not violations and prediction.fault is None
    return DryRun(
        commands.duration_s,
        len(commands.time_s),
        MappingProxyType(figures),
        violations,
        prediction.fault,
        sealed if sound else None,
    )


def moved_axes(trajectory: Record) -> tuple[str, ...]:
    """Return the axes whose commands change in a trajectory."""
    return tuple(
        axis
        for axis in trajectory.axes
        if trajectory.has(axis, Tap.CMD) and np.ptp(trajectory.signal(axis, Tap.CMD)) > 0.0
    )


def mode_of(robot: Robot, axes: Iterable[str]) -> str:
    """Return the ``mode`` of a record in which these axes move."""
    under_control = any(robot.axes[name].controller for name in axes)
    return "closed_loop" if under_control else "open_loop"


def _figures(
    axis: Axis,
    commands: Record,
    name: str,
    period_s: float,
    errors: Mapping[str, TrackingError],
) -> AxisFigures:
    time_s, command = commands.time_s, commands.signal(name, Tap.CMD)
    speed = acceleration = 0.0
    if len(time_s) > 1:
        speed = _peak(jump_speeds(time_s, command, period_s))
        pieces = accelerations(
            time_s, command, resolution_of(axis), axis.max_acceleration, period_s
        )
        acceleration = max(_peak(seen.value) for seen in pieces)
    error = errors.get(name)
    return AxisFigures(
        unit=commands.units[name],
        start=float(command[0]),
        end=float(command[-1]),
        lowest=float(command.min()),
        highest=float(command.max()),
        peak_speed=speed,
        peak_acceleration=acceleration,
        bounds=Bounds(axis.range, axis.max_speed, axis.max_acceleration, voltage_bounds(axis)),
        tracking_rms=None if error is None else error.rms,
        tracking_peak=None if error is None else error.peak,
    )


def _peak(values: FloatArray) -> float:
    return float(np.abs(values).max())
