"""A dry run: the demands of a trajectory on a machine, and the predicted tracking errors."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.messages import (
    AxisName,
    FieldList,
    Message,
    join_lines,
    message,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Axis, Robot
from rotemina.sim.trajectory.axis_limits import get_command_resolution, get_voltage_bounds
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory
from rotemina.sim.trajectory.prediction import TrackingError, predict_motion
from rotemina.sim.trajectory.speed_and_acceleration import (
    DEFAULT_SETPOINT_PERIOD_S,
    compute_accelerations,
    compute_jump_speeds,
)
from rotemina.sim.trajectory.trajectory_excesses import LimitViolation, find_violations


class AxisBounds(NamedTuple):
    """The bounds of an axis: m or rad, per s, per s², V; None if not declared."""

    range: tuple[float, float]
    max_speed: float | None
    max_acceleration: float | None
    voltage_range: tuple[float, float] | None


@dataclass(frozen=True, slots=True)
class AxisDemands:
    """The demands of a trajectory on one axis, in ``unit`` (m or rad), per s and per s².

    ``peak_speed`` is the maximum speed with which a device jumps from row to row.
    ``peak_acceleration`` is computed over a window in which rounding contributes little. Both are
    large if rows are farther apart than set-points. ``tracking_rms`` and ``tracking_peak`` compare
    the position that the nominal model predicts with the command at each row. They are None if
    there is no prediction.
    """

    unit: str
    start: float
    end: float
    lowest: float
    highest: float
    peak_speed: float
    peak_acceleration: float
    bounds: AxisBounds
    tracking_rms: float | None
    tracking_peak: float | None


@dataclass(frozen=True, slots=True)
class DryRun:
    """The result of a dry run: figures of each axis, and the violated limits.

    Attributes
    ----------
    duration_s : float
    rows : int
    axes : mapping axis -> AxisFigures
        In the order of the trajectory.
    violations : tuple of LimitViolation
        They include predicted motion outside the range.
    prediction_fault : str, optional
        The reason why the motion cannot be predicted.
    checked : CheckedTrajectory, optional
        The trajectory to play; None if it must not be played.
    """

    duration_s: float
    rows: int
    axes: Mapping[str, AxisDemands]
    violations: tuple[LimitViolation, ...]
    prediction_fault: str | None = None
    checked: CheckedTrajectory | None = None

    @property
    def objections(self) -> tuple[Message, ...]:
        """The reasons why the machine must not play the trajectory; empty if it may."""
        excesses = tuple(violation.message for violation in self.violations)
        if self.prediction_fault is None:
            return excesses
        fault = message("engine", "the model cannot predict its motion: {fault}")
        return (*excesses, fault.fill(fault=self.prediction_fault))

    @property
    def moved_axes(self) -> tuple[str, ...]:
        """The axes whose commands change."""
        return tuple(name for name, axis in self.axes.items() if axis.highest > axis.lowest)

    @property
    def axes_without_limit(self) -> tuple[str, ...]:
        """The moving axes without a speed limit or without an acceleration limit."""
        bounds = {axis: self.axes[axis].bounds for axis in self.moved_axes}
        return tuple(
            axis
            for axis, axis_bounds in bounds.items()
            if axis_bounds.max_speed is None or axis_bounds.max_acceleration is None
        )

    @property
    def verdict(self) -> Message:
        """A sentence on the checked limits and the missing ones, for an allowed trajectory."""
        speed, acceleration = message("engine", "the speed"), message("engine", "the acceleration")
        checked: list[Message] = [message("engine", "the range")]
        missing: list[Message] = []
        bounds = {axis: self.axes[axis].bounds for axis in self.moved_axes}
        if any(axis_bounds.voltage_range is not None for axis_bounds in bounds.values()):
            checked.append(message("engine", "the voltage"))
        for quantity, limits in (
            (speed, {axis: axis_bounds.max_speed for axis, axis_bounds in bounds.items()}),
            (
                acceleration,
                {axis: axis_bounds.max_acceleration for axis, axis_bounds in bounds.items()},
            ),
        ):
            for quantities_of_axes, is_missing in ((checked, False), (missing, True)):
                axes = [
                    AxisName(axis)
                    for axis, limit in limits.items()
                    if (limit is None) is is_missing
                ]
                if axes:
                    template = message("engine", "{quantity} of {axes}")
                    quantities_of_axes.append(
                        template.fill(quantity=quantity, axes=FieldList(tuple(axes)))
                    )
        if not missing:
            return message("engine", "within the limits")
        return message("engine", "inside {checked}; no limit is stated for {missing}").fill(
            checked=FieldList(tuple(checked)), missing=FieldList(tuple(missing))
        )

    @property
    def allowed(self) -> bool:
        """Whether the machine may play the trajectory."""
        return self.checked is not None

    def require(self) -> CheckedTrajectory:
        """Return the trajectory to play.

        Raises
        ------
        OutOfLimitsError
            If the machine must not play it; the message lists all objections.
        """
        if self.checked is None:
            raise OutOfLimitsError(join_lines(self.objections))
        return self.checked


def dry_run(
    robot: Robot,
    trajectory: Record,
    *,
    setpoint_period_s: float = DEFAULT_SETPOINT_PERIOD_S,
    corrected: Robot | None = None,
) -> DryRun:
    """Predict the demands and tracking errors of a trajectory without moving the machine.

    ``setpoint_period_s`` is the set-point period of the device that will play the trajectory.
    ``corrected`` is the same robot with the effects that a diagnosis found. If given, it is used
    for the tracking errors, but whether the trajectory may be played does not depend on it.

    Raises
    ------
    TrajectoryError
        If the trajectory does not fit the robot: it has an unknown axis, the wrong quantity, or an
        axis moved by a force without a controller.
    """
    sealed = CheckedTrajectory.seal(robot, trajectory, setpoint_period_s)
    commands = sealed.commands
    violations = find_violations(robot, commands, setpoint_period_s=setpoint_period_s)
    prediction = predict_motion(robot, commands, setpoint_period_s)
    violations += prediction.violations
    if corrected is not None:
        corrected_prediction = predict_motion(corrected, commands, setpoint_period_s)
        prediction = replace(prediction, errors=corrected_prediction.errors)
    figures = {
        name: _compute_figures(
            robot.axes[name], commands, name, setpoint_period_s, prediction.errors
        )
        for name in commands.axes
    }
    is_allowed = not violations and prediction.fault is None
    return DryRun(
        commands.duration_s,
        len(commands.time_s),
        MappingProxyType(figures),
        violations,
        prediction.fault,
        sealed if is_allowed else None,
    )


def find_moved_axes(trajectory: Record) -> tuple[str, ...]:
    """Return the axes whose commands change in a trajectory."""
    return tuple(
        axis
        for axis in trajectory.axes
        if trajectory.has(axis, Tap.CMD) and np.ptp(trajectory.signal(axis, Tap.CMD)) > 0.0
    )


def find_mode(robot: Robot, axes: Iterable[str]) -> str:
    """Return the ``mode`` entry of a record in which these axes move."""
    has_controller = any(robot.axes[name].controller for name in axes)
    return "closed_loop" if has_controller else "open_loop"


def _compute_figures(
    axis: Axis,
    commands: Record,
    name: str,
    period_s: float,
    errors: Mapping[str, TrackingError],
) -> AxisDemands:
    time_s, command = commands.time_s, commands.signal(name, Tap.CMD)
    speed = acceleration = 0.0
    if len(time_s) > 1:
        speed = _find_peak(compute_jump_speeds(time_s, command, period_s))
        pieces = compute_accelerations(
            time_s, command, get_command_resolution(axis), axis.max_acceleration, period_s
        )
        acceleration = max(_find_peak(piece.value) for piece in pieces)
    error = errors.get(name)
    return AxisDemands(
        unit=commands.units[name],
        start=float(command[0]),
        end=float(command[-1]),
        lowest=float(command.min()),
        highest=float(command.max()),
        peak_speed=speed,
        peak_acceleration=acceleration,
        bounds=AxisBounds(
            axis.range, axis.max_speed, axis.max_acceleration, get_voltage_bounds(axis)
        ),
        tracking_rms=None if error is None else error.rms,
        tracking_peak=None if error is None else error.peak,
    )


def _find_peak(values: FloatArray) -> float:
    return float(np.abs(values).max())
