"""The pace of a replay by a clock: speed, pauses and jumps."""

import time

from rotemina.app.motion.recording.replay import Replay
from rotemina.drivers.clock import Clock

SPEEDS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
_LONGEST_STEP_S = 0.25  # a screen that was late does not make up for it


class PacedReplay:
    """A replay with the controls of a player; paused at the begin until :meth:`play`.

    Times are seconds from the begin of the recording. Not to be used by several threads.

    Parameters
    ----------
    replay : Replay
    clock : callable
        The host's time, s.
    """

    def __init__(self, replay: Replay, clock: Clock = time.monotonic) -> None:
        self.replay = replay
        self.duration_s = replay.recording.ended_s - replay.recording.began_s
        self.playing = False
        self._speed = 1.0
        self._clock = clock
        self._before_s = clock()
        self._wanted_s: float | None = None
        replay.seek(replay.recording.began_s)

    @property
    def at_s(self) -> float:
        """Where the replay is, or will be with the next step."""
        if self._wanted_s is not None:
            return self._wanted_s
        return self.replay.host_time_s - self.replay.recording.began_s

    @property
    def speed(self) -> float:
        """How many times as fast as it happened."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        if not SPEEDS[0] <= speed <= SPEEDS[-1]:
            raise ValueError(f"speed {speed:g}: must be {SPEEDS[0]:g} to {SPEEDS[-1]:g}")
        self._speed = speed

    def play(self) -> None:
        """Advance; from the begin, where the end is reached."""
        if self.at_s >= self.duration_s:
            self.seek(0.0)
        self.playing = True

    def pause(self) -> None:
        """Stay where it is."""
        self.playing = False

    def seek(self, at_s: float) -> None:
        """Jump with the next step: of many jumps in between only the last one costs anything."""
        self._wanted_s = min(max(at_s, 0.0), self.duration_s)

    def step(self) -> None:
        """Advance by the time since the step before; pause where the end is reached."""
        before_s, self._before_s = self._before_s, self._clock()
        if self._wanted_s is not None:
            self.replay.seek(self.replay.recording.began_s + self._wanted_s)
            self._wanted_s = None
        elif self.playing:
            self.replay.advance(self._speed * min(self._before_s - before_s, _LONGEST_STEP_S))
        if self.replay.ended:
            self.playing = False
