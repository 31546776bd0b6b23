"""A dry run: what a trajectory asks of a machine, and how well the model expects it to follow."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, Robot
from rotemina.sim.trajectory.kinematics import accelerations, jump_speeds
from rotemina.sim.trajectory.limits import (
    Violation,
    commands_of,
    controller_of,
    find_violations,
    resolution_of,
    voltage_bounds,
)


class Bounds(NamedTuple):
    """What limits an axis: m or rad, per s, per s², V; None where nothing is declared."""

    range: tuple[float, float]
    max_speed: float | None
    max_acceleration: float | None
    voltage_range: tuple[float, float] | None


@dataclass(frozen=True, slots=True)
class AxisFigures:
    """What a trajectory asks of one axis, in ``unit`` (m or rad), per s and per s².

    ``peak_speed`` is taken from row to row, ``peak_acceleration`` over the window in which
    rounding weighs little. ``tracking_rms`` and ``tracking_peak`` compare the position that the
    nominal model predicts with the command at each row; None where the model gives none.
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

    ``prediction_fault`` says why there is no prediction, where there is none.
    """

    duration_s: float
    rows: int
    axes: Mapping[str, AxisFigures]
    violations: tuple[Violation, ...]
    prediction_fault: str | None = None

    @property
    def allowed(self) -> bool:
        """Whether the machine may play the trajectory."""
        return not self.violations


def dry_run(robot: Robot, trajectory: Record) -> DryRun:
    """Examine a trajectory without moving anything.

    Raises
    ------
    TrajectoryError
        If the trajectory is not one for this robot: an axis that it lacks, the wrong quantity, a
        force that no controller holds.
    """
    commands = commands_of(robot, trajectory)
    errors, fault = _tracking_errors(robot, trajectory, commands)
    figures = {
        name: _figures(robot.axes[name], trajectory, name, command, errors.get(name))
        for name, command in commands.items()
    }
    return DryRun(
        trajectory.duration_s,
        len(trajectory.time_s),
        MappingProxyType(figures),
        find_violations(robot, trajectory),
        fault,
    )


def as_played(robot: Robot, trajectory: Record) -> Record:
    """Return the commands of a trajectory alone, in the mode in which the robot plays them.

    Axes with a controller are under it, and the run starts at rest, whatever an earlier
    measurement of the same commands said.
    """
    commands = commands_of(robot, trajectory)
    under_control = any(controller_of(robot.axes[name]) for name in commands)
    return Record.from_signals(
        trajectory.time_s,
        {(name, Tap.CMD): command for name, command in commands.items()},
        {name: trajectory.units[name] for name in commands},
        {"mode": "closed_loop" if under_control else "open_loop"},
    )


def _tracking_errors(
    robot: Robot, trajectory: Record, commands: Mapping[str, FloatArray]
) -> tuple[dict[str, FloatArray], str | None]:
    try:
        response = nominal_response(robot, as_played(robot, trajectory))
    except PlantError as error:
        return {}, str(error)
    return {n: response.signal(n, Tap.REF) - command for n, command in commands.items()}, None


def _figures(
    axis: Axis, trajectory: Record, name: str, command: FloatArray, error: FloatArray | None
) -> AxisFigures:
    time_s = trajectory.time_s
    speed = acceleration = 0.0
    if len(time_s) > 1:
        speed = _peak(jump_speeds(time_s, command))
        seen = accelerations(time_s, command, resolution_of(axis), axis.max_acceleration)
        acceleration = _peak(seen.value)
    return AxisFigures(
        unit=trajectory.units[name],
        start=float(command[0]),
        end=float(command[-1]),
        lowest=float(command.min()),
        highest=float(command.max()),
        peak_speed=speed,
        peak_acceleration=acceleration,
        bounds=Bounds(axis.range, axis.max_speed, axis.max_acceleration, voltage_bounds(axis)),
        tracking_rms=None if error is None else _rms(error),
        tracking_peak=None if error is None else _peak(error),
    )


def _peak(values: FloatArray) -> float:
    return float(np.abs(values).max())


def _rms(values: FloatArray) -> float:
    peak = _peak(values)  # taken out first: the response of an unstable loop may have no square
    return peak * float(np.sqrt(np.mean((values / peak) ** 2))) if peak > 0 else 0.0
