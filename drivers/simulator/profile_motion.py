"""Execution of a profile by the simulated machine, tick by tick."""

from math import ceil

import numpy as np

from rotemina.drivers.abilities import MotionProfile
from rotemina.sim.arrays import FloatArray, IntArray

# Rounding error of the duration, as a fraction of a tick.
_TICK_TOLERANCE = 1e-6


class ProfileMotion:
    """Motion along a profile that begins at ``start`` (m or rad), tick by tick.

    Tick 1 is the first tick after the trigger. At the last tick the axis is at the end of the
    profile. If the duration is not a whole number of ticks, the axis arrives late, by less than one
    tick.
    """

    def __init__(self, profile: MotionProfile, index: int, start: float, tick_s: float) -> None:
        self.index = index
        self.start = start
        self.tick_count = max(1, ceil(profile.duration_s / tick_s - _TICK_TOLERANCE))
        self.elapsed_ticks = 0
        self._tick_s = tick_s
        segments = profile.segments
        self._duration_s = np.array([segment.duration_s for segment in segments])
        self._boundaries_s = np.concatenate([[0.0], np.cumsum(self._duration_s)])
        displacements = np.array([segment.displacement for segment in segments])
        self._segment_starts = start + np.concatenate([[0.0], np.cumsum(displacements)])
        self._c1, self._c2, self._c3 = np.array(
            [(segment.c1, segment.c2, segment.c3) for segment in segments]
        ).T

    @property
    def progress(self) -> float:
        """Fraction of the profile that has been executed, 0 to 1."""
        return self.elapsed_ticks / self.tick_count

    @property
    def has_ended(self) -> bool:
        """Whether the last tick of the profile has passed."""
        return self.elapsed_ticks >= self.tick_count

    def advance(self, ticks: int) -> FloatArray:
        """Return the commands (n,) of the next ``ticks`` ticks, or of the rest, m or rad."""
        tick_numbers = np.arange(
            self.elapsed_ticks + 1, min(self.elapsed_ticks + ticks, self.tick_count) + 1
        )
        self.elapsed_ticks += len(tick_numbers)
        time_s = np.asarray(tick_numbers * self._tick_s, dtype=np.float64)
        segment, tau = self._find_segments(time_s)
        displacement = (
            (self._c3[segment] * tau + self._c2[segment]) * tau + self._c1[segment]
        ) * tau
        return np.asarray(self._segment_starts[segment] + displacement, dtype=np.float64)

    def compute_velocity(self) -> float:
        """Return the speed at the latest tick, m/s or rad/s."""
        segment, tau = self._find_segments(np.array([self.elapsed_ticks * self._tick_s]))
        slope = (3.0 * self._c3[segment] * tau + 2.0 * self._c2[segment]) * tau + self._c1[segment]
        return float((slope / self._duration_s[segment])[0])

    def _find_segments(self, time_s: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the segment indices (n,) and τ (n,) at times (n,) since the trigger, s."""
        indices = np.searchsorted(self._boundaries_s, time_s, side="right") - 1
        segment = np.clip(indices, 0, len(self._duration_s) - 1)
        tau = np.clip((time_s - self._boundaries_s[segment]) / self._duration_s[segment], 0.0, 1.0)
        return segment.astype(np.int64), np.asarray(tau)
