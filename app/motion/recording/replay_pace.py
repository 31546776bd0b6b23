"""Playback of a replay in real time: speed, pauses and jumps."""

import time

from rotemina.app.motion.recording.replay import Replay
from rotemina.drivers.contract import Clock

REPLAY_SPEEDS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
# A late step advances by at most this time, so that the replay does not jump.
_MAX_STEP_S = 0.25


class PacedReplay:
    """Replay with the controls of a player; paused until :meth:`play`.

    Times are seconds from the start of the recording. Use it on one thread only.

    Parameters
    ----------
    replay : Replay
    clock : callable
        Returns the host's time, s.
    """

    def __init__(self, replay: Replay, clock: Clock = time.monotonic) -> None:
        self.replay = replay
        self.duration_s = replay.recording.ended_s - replay.recording.began_s
        self.is_playing = False
        self._speed = 1.0
        self._clock = clock
        self._last_step_s = clock()
        self._seek_target_s: float | None = None
        replay.seek(replay.recording.began_s)

    @property
    def position_s(self) -> float:
        """Position of the replay, or the target of a pending jump, s."""
        if self._seek_target_s is not None:
            return self._seek_target_s
        return self.replay.host_time_s - self.replay.recording.began_s

    @property
    def speed(self) -> float:
        """Ratio of the replay's speed to the speed of the recording."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        if not REPLAY_SPEEDS[0] <= speed <= REPLAY_SPEEDS[-1]:
            raise ValueError(
                f"speed {speed:g}: must be {REPLAY_SPEEDS[0]:g} to {REPLAY_SPEEDS[-1]:g}"
            )
        self._speed = speed

    def play(self) -> None:
        """Start to advance; at the end, start again from the beginning."""
        if self.position_s >= self.duration_s:
            self.seek(0.0)
        self.is_playing = True

    def pause(self) -> None:
        """Stop advancing and keep the position."""
        self.is_playing = False

    def seek(self, position_s: float) -> None:
        """Jump at the next step; of several jumps before that step only the last one is made."""
        self._seek_target_s = min(max(position_s, 0.0), self.duration_s)

    def step(self) -> None:
        """Advance by the time since the previous step; pause at the end."""
        last_step_s, self._last_step_s = self._last_step_s, self._clock()
        if self._seek_target_s is not None:
            self.replay.seek(self.replay.recording.began_s + self._seek_target_s)
            self._seek_target_s = None
        elif self.is_playing:
            self.replay.advance(self._speed * min(self._last_step_s - last_step_s, _MAX_STEP_S))
        if self.replay.has_ended:
            self.is_playing = False
