"""Execution of a profile by the simulated machine: its polynomial at each tick."""

from math import ceil

import numpy as np

from rotemina.drivers.profile import Profile
from rotemina.sim.arrays import FloatArray, IntArray

_ON_TIME = 1e-6  # of a tick: what is late by less is on time


class ProfileMotion:
    """A profile that begins at ``start`` (m or rad), evaluated tick by tick.

    Tick 1 is the first after the trigger; at the last one the axis is at the profile's end, which
    it reaches up to a tick late where its duration is no whole number of ticks.
    """

    def __init__(self, profile: Profile, index: int, start: float, tick_s: float) -> None:
        self.index = index
        self.start = start
        self.count = max(1, ceil(profile.duration_s / tick_s - _ON_TIME))
        self.ticks = 0
        self._tick_s = tick_s
        segments = profile.segments
        self._duration_s = np.array([one.duration_s for one in segments])
        self._begins_s = np.concatenate([[0.0], np.cumsum(self._duration_s)])
        lengths = np.array([one.length for one in segments])
        self._from = start + np.concatenate([[0.0], np.cumsum(lengths)])
        self._c1, self._c2, self._c3 = np.array([(one.c1, one.c2, one.c3) for one in segments]).T

    @property
    def progress(self) -> float:
        """How much of it has been run, 0 to 1."""
        return self.ticks / self.count

    @property
    def ended(self) -> bool:
        """Whether its last tick has passed."""
        return self.ticks >= self.count

    def advance(self, ticks: int) -> FloatArray:
        """Return the commands (n,) of the next ticks, m or rad; fewer where it ends before."""
        number = np.arange(self.ticks + 1, min(self.ticks + ticks, self.count) + 1)
        self.ticks += len(number)
        segment, tau = self._place(np.asarray(number * self._tick_s, dtype=np.float64))
        way = ((self._c3[segment] * tau + self._c2[segment]) * tau + self._c1[segment]) * tau
        return np.asarray(self._from[segment] + way, dtype=np.float64)

    def velocity(self) -> float:
        """Return the speed at the latest tick, m/s or rad/s."""
        segment, tau = self._place(np.array([self.ticks * self._tick_s]))
        slope = (3.0 * self._c3[segment] * tau + 2.0 * self._c2[segment]) * tau + self._c1[segment]
        return float((slope / self._duration_s[segment])[0])

    def _place(self, time_s: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return segments (n,) and how much of each has passed (n,), at times since the trigger."""
        found = np.searchsorted(self._begins_s, time_s, side="right") - 1
        segment = np.clip(found, 0, len(self._duration_s) - 1)
        tau = np.clip((time_s - self._begins_s[segment]) / self._duration_s[segment], 0.0, 1.0)
        return segment.astype(np.int64), np.asarray(tau)
