"""Interpolation of a trajectory for a machine whose ticks are finer than the rows.

Normally a row is held until the next row begins. A control loop with reference feed-forward would
turn each of these small steps into a large spike. So the path between rows follows monotone cubics,
which do not overshoot the rows (Fritsch and Butland, SIAM Journal on Scientific and Statistical
Computing 5 (1984) 300–304). A row that lasts clearly longer than a sample interval is held, and the
path moves to the next row during its last sample interval.
"""

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import Record, Tap

# A row that lasts longer than this many sample intervals is held.
_MAX_INTERPOLATED_SAMPLES = 1.5


class TrajectoryInterpolator:
    """Interpolates the commands of a trajectory.

    Parameters
    ----------
    trajectory : Record
    axes : tuple of str
        Axes of the machine.
    sample_s : float
        Interval between samples.
    """

    def __init__(self, trajectory: Record, axes: tuple[str, ...], sample_s: float) -> None:
        elapsed_s = trajectory.time_s - trajectory.time_s[0]
        self._columns = [
            axes.index(column.axis) for column in trajectory.columns if column.tap is Tap.CMD
        ]
        names = [axes[column] for column in self._columns]
        rows = np.stack([trajectory.signal(name, Tap.CMD) for name in names], axis=1)
        held_rows = np.flatnonzero(np.diff(elapsed_s) > _MAX_INTERPOLATED_SAMPLES * sample_s)
        insertion = held_rows + 1
        time_s = np.insert(elapsed_s, insertion, elapsed_s[insertion] - sample_s)
        self._end_s = float(elapsed_s[-1])
        self._last_row = rows[-1]
        self._path = None
        if len(time_s) > 1:
            self._path = scipy.interpolate.PchipInterpolator(
                time_s, np.insert(rows, insertion, rows[held_rows], axis=0)
            )
            self._slope = self._path.derivative()

    def smooth_commands(self, time_s: FloatArray, command: FloatArray) -> FloatArray:
        """Return the commands (n, axes) with the trajectory's axes interpolated.

        Parameters
        ----------
        time_s : (n,)
            Times since the first row.
        command : (n, axes)
            Commands in which each row is held until the next, m or rad.
        """
        smooth_command = command.copy()
        if self._path is None:
            smooth_command[:, self._columns] = self._last_row
        else:
            smooth_command[:, self._columns] = self._path(np.minimum(time_s, self._end_s))
        return smooth_command

    def compute_velocity(self, time_s: float, axis_count: int) -> FloatArray:
        """Return the speed (axes,) at a time since the first row, m/s or rad/s."""
        velocity = np.zeros(axis_count)
        if self._path is not None and time_s < self._end_s:
            velocity[self._columns] = self._slope(time_s)
        return velocity
