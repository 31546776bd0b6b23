"""Interpolation of a trajectory for a machine with finer ticks than rows.

Rows are held until the next one begins. A loop that is led by its reference would answer each of
these small jumps with a large one; so the path goes from row to row along monotone cubics, which
pass no row (Fritsch and Butland, SIAM Journal on Scientific and Statistical Computing 5 (1984)
300–304). A row that lasts for longer than a sample is held, and left within the last sample of it.
"""

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Record, Tap

_LONG = 1.5  # samples: a row that lasts longer is held


class SmoothRows:
    """The paths of a trajectory's axes.

    Parameters
    ----------
    trajectory : Record
    axes : tuple of str
        Of the machine.
    sample_s : float
    """

    def __init__(self, trajectory: Record, axes: tuple[str, ...], sample_s: float) -> None:
        since_s = trajectory.time_s - trajectory.time_s[0]
        self._columns = [axes.index(one.axis) for one in trajectory.columns if one.tap is Tap.CMD]
        names = [axes[column] for column in self._columns]
        rows = np.stack([trajectory.signal(name, Tap.CMD) for name in names], axis=1)
        held = np.flatnonzero(np.diff(since_s) > _LONG * sample_s)
        place = held + 1
        time_s = np.insert(since_s, place, since_s[place] - sample_s)
        self._end_s = float(since_s[-1])
        self._last = rows[-1]
        self._path = None
        if len(time_s) > 1:
            self._path = scipy.interpolate.PchipInterpolator(
                time_s, np.insert(rows, place, rows[held], axis=0)
            )
            self._slope = self._path.derivative()

    def commands(self, time_s: FloatArray, command: FloatArray) -> FloatArray:
        """Return commands (n, axes) with those of the paths at times (n,) since the first row."""
        smooth = command.copy()
        if self._path is None:
            smooth[:, self._columns] = self._last
        else:
            smooth[:, self._columns] = self._path(np.minimum(time_s, self._end_s))
        return smooth

    def velocity(self, time_s: float, axes: int) -> FloatArray:
        """Return the speed (axes,) at a time, per s."""
        velocity = np.zeros(axes)
        if self._path is not None and time_s < self._end_s:
            velocity[self._columns] = self._slope(time_s)
        return velocity
