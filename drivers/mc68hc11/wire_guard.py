"""The last check before the line: no command outside an axis' range or above its speed goes out.

It reads the bytes themselves, as a board would, so that it depends on nothing that has led to them.
What it refuses is an error of this program.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from rotemina.drivers.errors import LimitError
from rotemina.drivers.mc68hc11.framing import Decoder, Frame
from rotemina.drivers.mc68hc11.host_messages import (
    BeginProfile,
    BeginStream,
    MoveTo,
    MoveVelocity,
    Segments,
    SetPoint,
    TriggerProfile,
)
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.profile_upload import FRACTION
from rotemina.sim.messages import AxisName, message

_INDICES = 256  # segments of a stream, then their index is 0 again


class StepLimits(NamedTuple):
    """Limits of one axis of a board, in whole steps and steps per second."""

    name: str
    low: int
    high: int
    max_speed: int


class WireGuard:
    """The check of all that is written to one board.

    Parameters
    ----------
    limits : mapping of int to StepLimits
        Of each axis, by the board's number of it.
    commanded : callable
        Return where its axes were commanded last, steps, as the board says; empty if it is unknown.
    """

    def __init__(
        self, limits: Mapping[int, StepLimits], commanded: Callable[[], tuple[int, ...]]
    ) -> None:
        self._limits = dict(limits)
        self._commanded = commanded
        # Where each segment of a stream begins, steps with their fractions, by its index.
        self._stream: dict[int, tuple[int, ...]] = {}
        self._stream_hold, self._stream_fraction = 1, 0
        self._profile_axis = 0
        self._profile: dict[int, bytes] = {}
        self._checks: dict[int, tuple[type[Message], Callable[..., None]]] = {
            kind.TYPE: (kind, check)
            for kind, check in (
                (MoveTo, self._check_target),
                (MoveVelocity, self._check_velocity),
                (BeginStream, self._begin_stream),
                (SetPoint, self._check_setpoint),
                (BeginProfile, self._begin_profile),
                (Segments, self._note_segments),
                (TriggerProfile, self._check_profile),
            )
        }

    def check(self, frame: Frame) -> None:
        """Refuse a frame that commands what the axes must not do.

        Raises
        ------
        LimitError
            With the axis, the value and the bound.
        """
        if frame.type in self._checks:
            kind, check = self._checks[frame.type]
            check(kind.unpacked(frame.payload))

    def _axis(self, number: int) -> StepLimits:
        if number not in self._limits:
            raise LimitError(
                message("engine", "a frame for axis {number}, which the board does not have").fill(
                    number=number
                )
            )
        return self._limits[number]

    def _require_inside(self, number: int, steps: int) -> None:
        axis = self._axis(number)
        if not axis.low <= steps <= axis.high:
            raise LimitError(
                message(
                    "engine",
                    "axis {axis}: a command of {steps} steps is outside its range {low} to {high}",
                ).fill(axis=AxisName(axis.name), steps=steps, low=axis.low, high=axis.high)
            )

    def _require_speed(self, number: int, speed: int) -> None:
        axis = self._axis(number)
        if abs(speed) > axis.max_speed:
            raise LimitError(
                message(
                    "engine",
                    "axis {axis}: a command of {speed} steps/s is above its limit {limit}",
                ).fill(axis=AxisName(axis.name), speed=speed, limit=axis.max_speed)
            )

    def _check_target(self, command: MoveTo) -> None:
        self._require_inside(command.axis, command.target)
        self._require_speed(command.axis, command.most_speed)

    def _check_velocity(self, command: MoveVelocity) -> None:
        self._require_speed(command.axis, command.speed)

    def _begin_stream(self, command: BeginStream) -> None:
        half = 1 << command.fraction >> 1
        self._stream_hold, self._stream_fraction = max(command.hold, 1), command.fraction
        self._stream = {0: tuple((at << command.fraction) + half for at in self._commanded())}

    def _check_setpoint(self, command: SetPoint) -> None:
        begin = self._stream.get(command.index)
        differences = command.differences()
        if begin is None or len(begin) != len(differences):
            raise LimitError(
                message("engine", "set-point {index}: it is not known where it begins").fill(
                    index=command.index
                )
            )
        count = command.ticks // self._stream_hold
        for number, (at, (first, second)) in enumerate(zip(begin, differences, strict=True)):
            if first or second:
                for way in _extremes(count, first, second):
                    self._require_inside(number, (at + way) >> self._stream_fraction)
        self._stream[(command.index + 1) % _INDICES] = tuple(
            at + _way(count, first, second)
            for at, (first, second) in zip(begin, differences, strict=True)
        )

    def _begin_profile(self, command: BeginProfile) -> None:
        self._axis(command.axis)
        self._profile_axis, self._profile = command.axis, {}

    def _note_segments(self, command: Segments) -> None:
        self._profile[command.index] = command.packed_segments

    def _check_profile(self, _command: TriggerProfile) -> None:
        commanded = self._commanded()
        self._axis(self._profile_axis)
        begin = commanded[self._profile_axis] * FRACTION + FRACTION // 2 if commanded else 0
        for index, packed in sorted(self._profile.items()):
            for part in Segments(index, packed).segments():
                for way in _extremes(part.ticks, part.first, part.second):
                    self._require_inside(self._profile_axis, (begin + way) // FRACTION)
                begin += _way(part.ticks, part.first, part.second)


class LineGuard:
    """The check of all that is written to one line."""

    def __init__(self) -> None:
        self._boards: dict[int, WireGuard] = {}

    def add(self, address: int, guard: WireGuard) -> None:
        """Check what is written to a board from now on."""
        self._boards[address] = guard

    def check(self, data: bytes) -> None:
        """Refuse bytes that command what the axes of a board must not do.

        Raises
        ------
        LimitError
            With the axis, the value and the bound.
        """
        for frame in Decoder(of_board=True).feed(data):
            if frame.address in self._boards:
                self._boards[frame.address].check(frame)


def _way(count: int, first: int, second: int) -> int:
    """Return how far a command has gone after some additions."""
    return count * first + count * (count + 1) // 2 * second


def _extremes(count: int, first: int, second: int) -> list[int]:
    """Return how far a command goes to either side in so many additions."""
    places = {1, count}
    if second:
        # The difference changes its sign here; it is whole, the place is not.
        turn = -first // second
        places |= {min(max(place, 1), count) for place in (turn - 1, turn, turn + 1)}
    return [_way(place, first, second) for place in places]
