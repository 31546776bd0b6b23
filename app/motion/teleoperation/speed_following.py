"""Following of a reference by speeds."""

from bisect import bisect_right
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from operator import itemgetter

import numpy as np

from rotemina.app.motion.state import SessionState
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import resolution_of
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits

GAIN_HZ = 12.0  # 1/s: an error is gone after a few times 0.08 s
_LAG_S, _LONGEST_LAG_S = 0.008, 0.05  # of an axis behind its reference: at first, and at most
_LEARNING = 0.02  # of what a lag is off by, each time
_QUICK = 200.0  # resolutions a second, from which a lag can be told
_KEPT_S = 0.5
_AT_REST = 0.5  # of a resolution: what is nearer is there
_LOST_S = 0.3  # of an axis' greatest speed: what is farther from its reference does not follow


@dataclass(slots=True)
class Lag:
    """The learned lag of axes behind their references, s."""

    seconds: float = _LAG_S

    def learn(self, error: float, speed: float) -> None:
        """Note an error, m or rad, at a speed of the reference, per s."""
        off_s = min(max(error / speed, -_LONGEST_LAG_S), _LONGEST_LAG_S)
        self.seconds = min(max(self.seconds + _LEARNING * off_s, 0.0), _LONGEST_LAG_S)


class Following:
    """Speeds that carry axes along a reference.

    A speed alone would let errors add up: of rounding, of delays, of a lease that ran out. So a
    part of the error is added to it, where the error is that of the moment at which the machine
    last told its command, against the reference of then: ``v = v_ref + g (x_ref(t') − x(t'))``.
    By how much an axis lags (steps of the loop, line, its own ramp) is learned from its motion, so
    that a lag that is as it should be is no error: it would be made up for, and overshot.
    """

    def __init__(self, robot: Robot, lag: Lag) -> None:
        self._lag = lag
        limits = SetpointLimits.of(robot)
        self._fastest = dict(zip(robot.axes, limits.speed.tolist(), strict=True))
        self._resolution = {name: resolution_of(axis) for name, axis in robot.axes.items()}
        self._past: deque[tuple[float, Mapping[str, float]]] = deque()

    def forget(self) -> None:
        """Begin with another reference."""
        self._past.clear()

    def wanted(self, now_s: float, joints: Mapping[str, float]) -> None:
        """Note where the axes are to be now, m or rad."""
        if not self._past or now_s > self._past[-1][0]:
            self._past.append((now_s, joints))
        while now_s - self._past[0][0] > _KEPT_S:
            self._past.popleft()

    def speeds(
        self, speeds: Mapping[str, float], state: SessionState, driving: bool
    ) -> dict[str, float]:
        """Return the speeds to send, per s; 0 where an axis has arrived.

        While nothing is ``driving`` an axis that is elsewhere was moved by someone else, and is
        not moved back.
        """
        sent = {}
        for axis, speed in speeds.items():
            error = self.error(axis, state)
            fastest = self._fastest[axis]
            resolution = max(self._resolution[axis], 1e-9 * fastest)
            if abs(speed) > _QUICK * resolution and driving:
                self._lag.learn(error, speed)
            if abs(speed) < resolution:
                speed = 0.0  # a tail that no one could see
            there = abs(error) <= _AT_REST * resolution * (1.0 + 1e-6)
            if speed == 0.0 and (there or not driving):
                sent[axis] = 0.0
            else:
                sent[axis] = float(np.clip(speed + GAIN_HZ * error, -fastest, fastest))
        return sent

    def lost(self, axes: Mapping[str, float], state: SessionState) -> str | None:
        """Return an axis that does not follow, or None."""
        for axis in axes:
            if abs(self.error(axis, state)) > _LOST_S * self._fastest[axis]:
                return axis
        return None

    def error(self, axis: str, state: SessionState) -> float:
        """Return how far an axis was from its reference when it last told its command."""
        if not self._past or axis not in state.command or state.sample_host_time_s is None:
            return 0.0
        then_s = state.sample_host_time_s - self._lag.seconds
        after = bisect_right(self._past, then_s, key=itemgetter(0))
        if after == 0:
            return 0.0  # told before there was a reference
        before_s, before = self._past[after - 1]
        if axis not in before:
            return 0.0
        wanted = before[axis]
        if after < len(self._past) and axis in self._past[after][1]:
            next_s, later = self._past[after]
            wanted += (later[axis] - wanted) * (then_s - before_s) / (next_s - before_s)
        return wanted - state.command[axis]
