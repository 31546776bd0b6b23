"""A trajectory to begin with: the shipped tour, or a slow swing of every axis of any robot."""

from importlib import resources

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, Robot
from rotemina.sim.trajectory.dry_run import dry_run

TOUR = "six_axis_tour.csv"
RATE_HZ = 1000.0  # rows that a device follows one by one: it holds what is farther apart
SHORTEST_S, LONGEST_S = 4.0, 60.0
_SWING = 0.2  # of the range, to each side of its middle
_SHARE = 0.5  # of the speed and acceleration that are allowed


def example_for(robot: Robot) -> Record:
    """Return the shipped six-axis tour where the robot can play it, else a swing of its axes."""
    shipped = resources.files("rotemina.resources.trajectories").joinpath(TOUR)
    with resources.as_file(shipped) as path:
        tour = read_record(path)
    if set(tour.axes) <= set(robot.axes) and dry_run(robot, tour).allowed:
        return tour
    return swing(robot)


def swing(robot: Robot) -> Record:
    """Return a smooth swing of all axes about the middle of their ranges, from rest to rest."""
    needed = {name: _needed_s(axis) for name, axis in robot.axes.items()}
    duration = min(max(SHORTEST_S, *needed.values()), LONGEST_S)
    # A very slow axis swings less rather than for hours: speeds go with the height of the swing.
    height = {n: _SWING * min(1.0, (duration / max(s, 1e-9)) ** 2) for n, s in needed.items()}
    time_s = np.arange(int(np.ceil(duration * RATE_HZ)) + 1) / RATE_HZ
    shape = _shape(time_s / time_s[-1])
    signals = {
        (name, Tap.CMD): axis.range[0] + axis.span * (0.5 + height[name] * shape)
        for name, axis in robot.axes.items()
    }
    units = {name: axis.unit or "m" for name, axis in robot.axes.items()}
    return Record.from_signals(time_s, signals, units, {"name": "swing of all axes"})


def _shape(share: FloatArray) -> FloatArray:
    """``sin(2πs)`` under ``sin²(πs)``: speed and acceleration are 0 at both ends."""
    return np.asarray(np.sin(np.pi * share) ** 2 * np.sin(2 * np.pi * share))


def _needed_s(axis: Axis) -> float:
    """Shortest duration that keeps speed and acceleration within their share, s."""
    share = np.linspace(0.0, 1.0, 2001)
    speed = np.gradient(_shape(share), share)
    swing = _SWING * axis.span
    needed = 0.0
    if axis.max_speed is not None:
        needed = swing * float(np.abs(speed).max()) / (_SHARE * axis.max_speed)
    if axis.max_acceleration is not None:
        peak = swing * float(np.abs(np.gradient(speed, share)).max())
        needed = max(needed, float(np.sqrt(peak / (_SHARE * axis.max_acceleration))))
    return needed
