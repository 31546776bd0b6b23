"""Straight move that is sent in pieces, so that it ends if the connection breaks.

A G-code controller has no watchdog and executes every line to its end. So the driver sends only as
much of the path as the controller needs to move without braking: the path of the next `ahead_s`
plus the braking distance. On a line that is too slow for that, the axes brake between pieces.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from rotemina.drivers.gcode.coordinates import StageAxis, compute_feed
from rotemina.sim.messages import format_fixed, message

# On a fast line, an answer and the next report together take less time.
_MIN_AHEAD_S = 0.25
# After the connection breaks, motion continues for this time plus the braking time.
_MAX_AHEAD_S = 0.5
_PIECE_S = 0.1
# Period of the reports on a fast line.
_REPORT_PERIOD_S = 0.05
# Maximum travel of an axis until a reading has confirmed its direction, mm or degrees.
_TRIAL_DISTANCE = 1.0
# A reading confirms the direction if it shows at least this fraction of the trial distance.
_MIN_TRIAL_RATIO = 0.5


@dataclass(slots=True)
class StraightMove:
    """A straight move from rest.

    Attributes
    ----------
    axes : tuple of StageAxis
        The axes that move.
    start, end : tuple of float
        Position of each of these axes in the controller's coordinates, mm or degrees.
    duration_s : float
        Duration if the axes did not have to accelerate and brake.
    braking_s : float
        Duration of braking.
    sent_fraction : float
        Fraction of the path that has been sent, 0 to 1.
    ahead_s : float
        How far ahead of the readings the path is sent, in seconds of motion.
    """

    axes: tuple[StageAxis, ...]
    start: tuple[float, ...]
    end: tuple[float, ...]
    duration_s: float
    braking_s: float
    sent_fraction: float = 0.0
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
        """Create the move to targets, m or rad; return None if no axis has to move.

        ``position`` is the position in the latest report, and ``round_trip_s`` the time that the
        controller takes to answer.
        """
        moves, duration_s, braking_s = [], 0.0, 0.0
        for axis in axes:
            if axis.name not in targets:
                continue
            end = axis.to_controller(targets[axis.name])
            distance = abs(end - position[axis.number])
            if distance == 0.0:
                continue
            speed = min(axis.speed, speeds.get(axis.name, axis.speed))
            moves.append((axis, position[axis.number], end))
            duration_s = max(duration_s, distance / (speed * axis.scale))
            braking_s = max(braking_s, speed / axis.acceleration)
        if not moves:
            return None
        moving_axes, starts, ends = zip(*moves, strict=True)
        # When a line arrives at the controller, the report that it is based on is at most two round
        # trips and one report period old.
        ahead_s = min(max(_MIN_AHEAD_S, 2.0 * round_trip_s + _REPORT_PERIOD_S), _MAX_AHEAD_S)
        return cls(moving_axes, starts, ends, duration_s, braking_s, ahead_s=ahead_s)

    @property
    def is_fully_sent(self) -> bool:
        """Whether the whole path has been sent."""
        return self.sent_fraction >= 1.0

    def make_next_line(
        self, position: Sequence[float], *, on_trial: Collection[str] = ()
    ) -> str | None:
        """Return the next piece as a jog if the controller needs it now, otherwise None.

        An axis ``on_trial`` moves by a millimetre or a degree at most.
        """
        max_fraction = min((self._compute_trial_fraction(axis) for axis in on_trial), default=1.0)
        if self.sent_fraction >= max_fraction:
            return None
        sent_ahead_s = (
            self.sent_fraction - self._compute_covered_fraction(position)
        ) * self.duration_s
        required_s = self.ahead_s + self.braking_s
        if sent_ahead_s >= required_s:
            return None
        fraction = self.sent_fraction + (required_s - sent_ahead_s + _PIECE_S) / self.duration_s
        # The last piece may be up to half a piece longer, so that no tiny piece follows.
        self.sent_fraction = (
            max_fraction if fraction > max_fraction - 0.5 * _PIECE_S / self.duration_s else fraction
        )
        words = [
            f"{axis.letter}{start + self.sent_fraction * (end - start):.4f}"
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
        ]
        distances = {
            axis: end - start
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
        }
        feed = compute_feed(distances, self.duration_s)
        return f"$J=G53 G21 G90 {' '.join(words)} F{feed:.3f}"

    def find_confirmed_axes(self, position: Sequence[float]) -> list[str]:
        """Return the axes that a reading shows moving towards their targets."""
        return [
            axis.name
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
            if (position[axis.number] - start) * (1.0 if end > start else -1.0)
            >= _MIN_TRIAL_RATIO * min(abs(end - start), _TRIAL_DISTANCE)
        ]

    def describe_path_deviation(self, position: Sequence[float]) -> str:
        """Describe an axis that is outside its path; return an empty text if there is none.

        An axis that moves in the wrong direction leaves its path.
        """
        for axis, start, end in zip(self.axes, self.start, self.end, strict=True):
            reading, slack = position[axis.number], axis.tolerance * axis.scale
            if not min(start, end) - slack <= reading <= max(start, end) + slack:
                return message(
                    "engine",
                    "axis {name} reads {at} during a move from {start} to {end} (controller "
                    "coordinates); check the direction and the settings of this axis, then home",
                ).fill(
                    name=axis.name,
                    at=format_fixed(reading, 3),
                    start=format_fixed(start, 3),
                    end=format_fixed(end, 3),
                )
        return ""

    def describe_position_error(self, position: Sequence[float]) -> str:
        """Describe an axis that is not at its target; return an empty text if all have arrived."""
        for axis, end in zip(self.axes, self.end, strict=True):
            reading = position[axis.number]
            if abs(reading - end) > axis.tolerance * axis.scale:
                return message(
                    "engine", "axis {name} is at {at} instead of {end} (controller coordinates)"
                ).fill(name=axis.name, at=format_fixed(reading, 3), end=format_fixed(end, 3))
        return ""

    def _compute_trial_fraction(self, name: str) -> float:
        for axis, start, end in zip(self.axes, self.start, self.end, strict=True):
            if axis.name == name:
                return min(1.0, _TRIAL_DISTANCE / abs(end - start))
        return 1.0

    def _compute_covered_fraction(self, position: Sequence[float]) -> float:
        """Return the fraction of the path that the axis with the most progress has covered."""
        return max(
            (position[axis.number] - start) / (end - start)
            for axis, start, end in zip(self.axes, self.start, self.end, strict=True)
        )
