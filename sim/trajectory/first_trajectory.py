"""A first example trajectory: the shipped tour, or a slow swing of all axes of any robot."""

from importlib import resources

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import Record, Tap, read_record
from rotemina.sim.robot import Axis, Robot
from rotemina.sim.trajectory.trajectory_demands import dry_run

TOUR_FILE = "six_axis_tour.csv"
# At this rate, a device follows row by row. Between more distant rows, it would hold and then jump.
RATE_HZ = 1000.0
MIN_DURATION_S, MAX_DURATION_S = 4.0, 60.0
# Amplitude of the swing relative to the range.
_SWING_RATIO = 0.2
# Speed and acceleration of the swing, relative to their limits.
_LIMIT_RATIO = 0.5


def make_example(robot: Robot) -> Record:
    """Return the shipped six-axis tour if the robot can play it, or else a swing of its axes."""
    shipped = resources.files("rotemina.resources.trajectories").joinpath(TOUR_FILE)
    with resources.as_file(shipped) as path:
        tour = read_record(path)
    if set(tour.axes) <= set(robot.axes) and dry_run(robot, tour).allowed:
        return tour
    return make_swing(robot)


def make_swing(robot: Robot) -> Record:
    """Return a smooth swing of all axes about the middle of their ranges, from rest to rest."""
    min_durations_s = {name: _find_min_duration_s(axis) for name, axis in robot.axes.items()}
    duration_s = min(max(MIN_DURATION_S, *min_durations_s.values()), MAX_DURATION_S)
    # A very slow axis gets a smaller swing, since otherwise the trajectory would take hours.
    amplitude_ratios = {
        name: _SWING_RATIO * min(1.0, (duration_s / max(min_duration_s, 1e-9)) ** 2)
        for name, min_duration_s in min_durations_s.items()
    }
    time_s = np.arange(int(np.ceil(duration_s * RATE_HZ)) + 1) / RATE_HZ
    shape = _compute_swing_shape(time_s / time_s[-1])
    signals = {
        (name, Tap.CMD): axis.range[0] + axis.span * (0.5 + amplitude_ratios[name] * shape)
        for name, axis in robot.axes.items()
    }
    units = {name: axis.unit or "m" for name, axis in robot.axes.items()}
    return Record.from_signals(time_s, signals, units, {"name": "swing of all axes"})


def _compute_swing_shape(phase: FloatArray) -> FloatArray:
    """Return ``sin²(πs) sin(2πs)``, whose speed and acceleration are 0 at both ends."""
    return np.asarray(np.sin(np.pi * phase) ** 2 * np.sin(2 * np.pi * phase))


def _find_min_duration_s(axis: Axis) -> float:
    """Return the shortest duration, s, that keeps a swing within ``_LIMIT_RATIO`` of its limits."""
    phase = np.linspace(0.0, 1.0, 2001)
    speed = np.gradient(_compute_swing_shape(phase), phase)
    swing = _SWING_RATIO * axis.span
    duration_s = 0.0
    if axis.max_speed is not None:
        duration_s = swing * float(np.abs(speed).max()) / (_LIMIT_RATIO * axis.max_speed)
    if axis.max_acceleration is not None:
        peak = swing * float(np.abs(np.gradient(speed, phase)).max())
        duration_s = max(duration_s, float(np.sqrt(peak / (_LIMIT_RATIO * axis.max_acceleration))))
    return duration_s
