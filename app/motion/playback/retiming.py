"""Retiming of a trajectory: a speed factor, and a smooth start in the middle of the path."""

from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_rounded
from rotemina.sim.records import Record

MIN_SPEED_RATIO, MAX_SPEED_RATIO = 0.01, 10.0
# Time from rest to full speed if a section starts in the middle of a path.
EASE_IN_S = 0.5
# Rows that follow within this many set-point periods are points of a curve, others single targets.
_MAX_CURVE_SPACING_PERIODS = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class RetimedSection:
    """The section of a trajectory that is played, and the map of its times to the whole.

    Attributes
    ----------
    trajectory : Record
        The section, whose times start at 0.
    path_s : (n,)
        Time of each row of the section in the whole trajectory, from the first row of the latter.
    """

    trajectory: Record
    path_s: FloatArray

    def find_path_time(self, elapsed_s: float) -> float:
        """Return the time in the whole trajectory, s, ``elapsed_s`` after the section began."""
        return float(np.interp(elapsed_s, self.trajectory.time_s, self.path_s))


def check_speed(speed: float) -> float:
    """Return the speed factor if it is valid.

    Raises
    ------
    InputError
        If the factor is not between 0.01 and 10.
    """
    if not MIN_SPEED_RATIO <= speed <= MAX_SPEED_RATIO:
        raise InputError(
            "playback: the speed {speed} must be {slowest} to {fastest} times that of "
            "the trajectory",
            speed=format_rounded(speed, 6),
            slowest=format_rounded(MIN_SPEED_RATIO, 6),
            fastest=format_rounded(MAX_SPEED_RATIO, 6),
        )
    return speed


def retime(
    trajectory: Record, *, row: int = 0, speed: float = 1.0, setpoint_period_s: float
) -> RetimedSection:
    """Return the section from ``row`` on, ``speed`` times as fast.

    If the section starts in the middle of a curve (rows at most two set-points apart), its speed
    rises linearly from 0 to full over T, half a second: ``p(τ) = τ²/2T`` for τ up to T. So the
    speed does not jump. The rows are then interpolated linearly at the device's set-points.

    Raises
    ------
    InputError
        If the speed or the row is invalid.
    """
    check_speed(speed)
    row_count = len(trajectory.time_s)
    if not 0 <= row < row_count:
        raise InputError(
            "playback: row {row}: the trajectory has rows 0 to {rows}", row=row, rows=row_count - 1
        )
    path_s = trajectory.time_s - trajectory.time_s[0]
    remainder = trajectory.select_rows(slice(row, None))
    path_s = path_s[row:]
    elapsed_s = (path_s - path_s[0]) / speed
    section = RetimedSection(replace(remainder, time_s=elapsed_s), path_s)
    # At the first row a trajectory starts as designed, so only later starts are smoothed.
    if row == 0 or len(elapsed_s) < 2:
        return section
    is_curve = float(np.diff(elapsed_s).max()) <= _MAX_CURVE_SPACING_PERIODS * setpoint_period_s
    return _ease_in(section, speed, setpoint_period_s) if is_curve else section


def _ease_in(section: RetimedSection, speed: float, period_s: float) -> RetimedSection:
    record = section.trajectory
    rise_s = min(EASE_IN_S, record.duration_s)
    # The average speed during the rise is half the full speed, so half the rise time is lost.
    duration_s = record.duration_s + 0.5 * rise_s
    elapsed_s = np.arange(np.floor(duration_s / period_s) + 1.0) * period_s
    if duration_s - elapsed_s[-1] > 1e-3 * period_s:
        elapsed_s = np.append(elapsed_s, elapsed_s[-1] + period_s)
    record_s_at_full_speed = elapsed_s - 0.5 * rise_s
    record_s = np.where(elapsed_s < rise_s, elapsed_s**2 / (2.0 * rise_s), record_s_at_full_speed)
    clipped_record_s = np.minimum(record_s, record.duration_s)
    values = np.column_stack(
        [np.interp(clipped_record_s, record.time_s, column) for column in record.values.T]
    )
    eased_record = replace(record, time_s=elapsed_s, values=values)
    return RetimedSection(eased_record, section.path_s[0] + speed * clipped_record_s)
