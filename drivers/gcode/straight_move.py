"""A straight move sent piece by piece, so that a torn line ends it.

A G-code controller has no watchdog: it goes on to the end of what it was told. So it is never told
more than it needs in order not to brake: the way of `_AHEAD_S`, and that of its braking.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from rotemina.drivers.gcode.coordinates import StageAxis, feed_of
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed

_AHEAD_S = 0.25  # more than an answer and the next report take
_PIECE_S = 0.1


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
    """

    axes: tuple[StageAxis, ...]
    start: tuple[float, ...]
    end: tuple[float, ...]
    seconds: float
    braking_s: float
    sent: float = 0.0

    @classmethod
    def of(
        cls,
        axes: Sequence[StageAxis],
        position: Sequence[float],
        targets: Mapping[str, float],
        speeds: Mapping[str, float],
    ) -> Self | None:
        """Return the move from a report's position to targets, m or rad, or None."""
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
        return cls(names, starts, ends, seconds, braking_s)

    @property
    def fully_sent(self) -> bool:
        """Whether the controller knows all of it."""
        return self.sent >= 1.0

    def line(self, position: Sequence[float]) -> str | None:
        """Return the next piece as a jog, where the controller needs it by now; None before."""
        if self.fully_sent:
            return None
        ahead_s = (self.sent - self._share(position)) * self.seconds
        least_s = _AHEAD_S + self.braking_s
        if ahead_s >= least_s:
            return None
        share = self.sent + (least_s - ahead_s + _PIECE_S) / self.seconds
        self.sent = 1.0 if share > 1.0 - 0.5 * _PIECE_S / self.seconds else share
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

    def missed(self, position: Sequence[float]) -> str:
        """Return which axis rests short of its end, and where; "" where all have arrived."""
        for axis, end in zip(self.axes, self.end, strict=True):
            at = position[axis.number]
            if abs(at - end) > 2.0 * axis.resolution * axis.scale:
                return message(
                    "engine", "axis {name} at {at} instead of {end} by the controller's count"
                ).fill(name=axis.name, at=fixed(at, 3), end=fixed(end, 3))
        return ""

    def _share(self, position: Sequence[float]) -> float:
        """Return how much of it lies behind, by the axis that goes farthest."""
        return max(
            (position[axis.number] - start) / (end - start)
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
        )
