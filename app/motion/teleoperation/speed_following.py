"""Control of axes by speed commands so that they follow a reference."""

from bisect import bisect_right
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from operator import itemgetter

import numpy as np

from rotemina.app.motion.state import SessionState
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import SetpointLimits, get_command_resolution

# An error decays with a time constant of 0.08 s.
ERROR_GAIN_PER_S = 12.0
# Initial and maximum lag of an axis behind its reference.
_INITIAL_LAG_S, _MAX_LAG_S = 0.008, 0.05
# Fraction of its error by which the lag is corrected in each step.
_LAG_LEARNING_RATE = 0.02
# The lag is learned only above this speed.
_MIN_LEARNING_SPEED_RESOLUTIONS_PER_S = 200.0
_REFERENCE_HISTORY_S = 0.5
# An axis has arrived if it is within this many resolutions of its reference.
_ARRIVAL_RESOLUTION_RATIO = 0.5
# An axis does not follow if its error exceeds the distance of this time at full speed.
_MAX_ERROR_S = 0.3


@dataclass(slots=True)
class LearnedLag:
    """Learned lag of axes behind their references, s."""

    seconds: float = _INITIAL_LAG_S

    def learn(self, error: float, speed: float) -> None:
        """Correct the lag by an error, m or rad, at a speed of the reference, per s."""
        correction_s = min(max(error / speed, -_MAX_LAG_S), _MAX_LAG_S)
        self.seconds = min(max(self.seconds + _LAG_LEARNING_RATE * correction_s, 0.0), _MAX_LAG_S)


class ReferenceFollower:
    """Controller that computes the speeds with which axes follow a reference.

    If only the speed of the reference were sent, errors from rounding, delays or expired leases
    would accumulate. Therefore a part of the error is added: ``v = v_ref + g (x_ref(t') − x(t'))``.
    The error is taken at the time t' at which the machine last reported its command.

    An axis always lags a little behind, because of the period of the loop, the line and its own
    ramp. This lag is learned from the motion and does not count as an error. Otherwise the axis
    would try to catch up and would overshoot.
    """

    def __init__(self, robot: Robot, lag: LearnedLag) -> None:
        self._lag = lag
        limits = SetpointLimits.of(robot)
        self._max_speeds = dict(zip(robot.axes, limits.speed.tolist(), strict=True))
        self._resolutions = {
            name: get_command_resolution(axis) for name, axis in robot.axes.items()
        }
        self._reference_history: deque[tuple[float, Mapping[str, float]]] = deque()

    def forget_reference(self) -> None:
        """Forget the reference before another one follows."""
        self._reference_history.clear()

    def note_reference(self, now_s: float, joints: Mapping[str, float]) -> None:
        """Add the reference of the axes at a time, m or rad."""
        if not self._reference_history or now_s > self._reference_history[-1][0]:
            self._reference_history.append((now_s, joints))
        while now_s - self._reference_history[0][0] > _REFERENCE_HISTORY_S:
            self._reference_history.popleft()

    def compute_speeds(
        self, speeds: Mapping[str, float], state: SessionState, driving: bool
    ) -> dict[str, float]:
        """Return the speeds to send, per s; 0 for an axis that has arrived.

        If the stick is not ``driving``, something else has moved an axis away from its reference.
        Such an axis is not moved back.
        """
        sent_speeds = {}
        for axis, speed in speeds.items():
            error = self.compute_error(axis, state)
            max_speed = self._max_speeds[axis]
            resolution = max(self._resolutions[axis], 1e-9 * max_speed)
            if abs(speed) > _MIN_LEARNING_SPEED_RESOLUTIONS_PER_S * resolution and driving:
                self._lag.learn(error, speed)
            if abs(speed) < resolution:
                # The end of an exponential approach is too slow to be visible.
                speed = 0.0
            has_arrived = abs(error) <= _ARRIVAL_RESOLUTION_RATIO * resolution * (1.0 + 1e-6)
            if speed == 0.0 and (has_arrived or not driving):
                sent_speeds[axis] = 0.0
            else:
                sent_speeds[axis] = float(
                    np.clip(speed + ERROR_GAIN_PER_S * error, -max_speed, max_speed)
                )
        return sent_speeds

    def find_lost_axis(self, axes: Mapping[str, float], state: SessionState) -> str | None:
        """Return an axis that does not follow its reference, or None."""
        for axis in axes:
            if abs(self.compute_error(axis, state)) > _MAX_ERROR_S * self._max_speeds[axis]:
                return axis
        return None

    def compute_error(self, axis: str, state: SessionState) -> float:
        """Return the error of an axis, reference minus command, at its latest reported command."""
        if (
            not self._reference_history
            or axis not in state.command
            or state.sample_host_time_s is None
        ):
            return 0.0
        reference_s = state.sample_host_time_s - self._lag.seconds
        next_index = bisect_right(self._reference_history, reference_s, key=itemgetter(0))
        # The command was reported before there was a reference.
        if next_index == 0:
            return 0.0
        previous_s, previous_joints = self._reference_history[next_index - 1]
        if axis not in previous_joints:
            return 0.0
        reference = previous_joints[axis]
        if (
            next_index < len(self._reference_history)
            and axis in self._reference_history[next_index][1]
        ):
            next_s, next_joints = self._reference_history[next_index]
            reference += (
                (next_joints[axis] - reference) * (reference_s - previous_s) / (next_s - previous_s)
            )
        return reference - state.command[axis]
