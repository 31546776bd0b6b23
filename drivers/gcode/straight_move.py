"""A straight move sent piece by piece, so that a torn line ends it.

A G-code controller has no watchdog: it goes on to the end of what it was told. So it is never told
more than it needs in order not to brake: the way of `ahead_s`, and that of its braking. On a line
that is too slow for that it brakes between pieces.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from rotemina.drivers.gcode.coordinates import StageAxis, feed_of
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed

_MIN_AHEAD_S = 0.25  # more than an answer and the next report take on a fast line
_MAX_AHEAD_S = 0.5  # so long motion goes on after a line is torn, and while it brakes
_PIECE_S = 0.1
_REPORT_S = 0.05  # between two reports of a fast line
# How far an axis goes before its reading has shown that it goes the right way, mm or degrees.
_TRIAL_WAY = 1.0
_SHARE_OF_TRIAL = 0.5  # of that, seen by a reading, is enough


@dataclass(slots=True)
class StraightMove:
    """A straight way from where the axes rest.

    Attributes
    ----------
    axes : tuple of StageAxis
        Those that move.
    start, end : tuple of float
        Of each, mm or degrees, as the controller counts.
    seconds : float
        How long it takes without speeding up and braking.
    braking_s : float
        How long braking takes.
    sent : float
        The share that the controller knows of.
    ahead_s : float
        The way of so many seconds is sent ahead of the readings.
    """

    axes: tuple[StageAxis, ...]
    start: tuple[float, ...]
    end: tuple[float, ...]
    seconds: float
    braking_s: float
    sent: float = 0.0
    ahead_s: float = _MIN_AHEAD_S

    @classmethod
    def of(
        cls,
        axes: Sequence[StageAxis],
        position: Sequence[float],
        targets: Mapping[str, float],
        speeds: Mapping[str, float],
        round_trip_s: float = 0.0,
    ) -> Self | None:
        """Return the move from a report's position to targets, m or rad, or None.

        ``round_trip_s`` is how long the controller takes to answer.
        """
        moved, seconds, braking_s = [], 0.0, 0.0
        for axis in axes:
            if axis.name not in targets:
                continue
            end = axis.rounded(targets[axis.name])
            way = abs(end - position[axis.number])
            if way == 0.0:
                continue
            speed = min(axis.speed, speeds.get(axis.name, axis.speed))
            moved.append((axis, position[axis.number], end))
            seconds = max(seconds, way / (speed * axis.scale))
            braking_s = max(braking_s, speed / axis.acceleration)
        if not moved:
            return None
        names, starts, ends = zip(*moved, strict=True)
        # A report is a round trip and its period old when the next line arrives, one trip later.
        ahead_s = min(max(_MIN_AHEAD_S, 2.0 * round_trip_s + _REPORT_S), _MAX_AHEAD_S)
        return cls(names, starts, ends, seconds, braking_s, ahead_s=ahead_s)

    @property
    def fully_sent(self) -> bool:
        """Whether the controller knows all of it."""
        return self.sent >= 1.0

    def line(self, position: Sequence[float], *, on_trial: Collection[str] = ()) -> str | None:
        """Return the next piece as a jog, where the controller needs it by now; None before.

        An axis ``on_trial`` goes no farther than a millimetre or a degree.
        """
        most = min((self._share_of_trial(axis) for axis in on_trial), default=1.0)
        if self.sent >= most:
            return None
        ahead_s = (self.sent - self._share(position)) * self.seconds
        least_s = self.ahead_s + self.braking_s
        if ahead_s >= least_s:
            return None
        share = self.sent + (least_s - ahead_s + _PIECE_S) / self.seconds
        self.sent = most if share > most - 0.5 * _PIECE_S / self.seconds else share
        words = [
            f"{axis.letter}{start + self.sent * (end - start):.4f}"
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
        ]
        whole = {
            axis: end - start
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
        }
        feed = feed_of(whole, self.seconds)
        return f"$J=G53 G21 G90 {' '.join(words)} F{feed:.3f}"

    def passed_trial(self, position: Sequence[float]) -> list[str]:
        """Return the axes that a reading shows on their way to their ends."""
        return [
            axis.name
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
            if (position[axis.number] - start) * (1.0 if end > start else -1.0)
            >= _SHARE_OF_TRIAL * min(abs(end - start), _TRIAL_WAY)
        ]

    def strayed(self, position: Sequence[float]) -> str:
        """Return which axis reads outside its way, as one that goes backwards; "" if none."""
        for axis, start, end in zip(self.axes, self.start, self.end, strict=True):
            at, slack = position[axis.number], axis.tolerance * axis.scale
            if not min(start, end) - slack <= at <= max(start, end) + slack:
                return message(
                    "engine",
                    "axis {name} reads {at} on its way from {start} to {end} by the controller's "
                    "count; check the direction and the settings of this axis, then home",
                ).fill(name=axis.name, at=fixed(at, 3), start=fixed(start, 3), end=fixed(end, 3))
        return ""

    def missed(self, position: Sequence[float]) -> str:
        """Return which axis rests short of its end, and where; "" where all have arrived."""
        for axis, end in zip(self.axes, self.end, strict=True):
            at = position[axis.number]
            if abs(at - end) > axis.tolerance * axis.scale:
                return message(
                    "engine", "axis {name} at {at} instead of {end} by the controller's count"
                ).fill(name=axis.name, at=fixed(at, 3), end=fixed(end, 3))
        return ""

    def _share_of_trial(self, name: str) -> float:
        for axis, start, end in zip(self.axes, self.start, self.end, strict=True):
            if axis.name == name:
                return min(1.0, _TRIAL_WAY / abs(end - start))
        return 1.0

    def _share(self, position: Sequence[float]) -> float:
        """Return how much of it lies behind, by the axis that goes farthest."""
        return max(
            (position[axis.number] - start) / (end - start)
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
        )
