"""Last check before the line: refuses commands outside an axis' range or above its speed.

The check decodes the bytes as a board would, so it does not depend on the code that made them. If
it refuses a frame, this program has a bug.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from rotemina.drivers.contract import LimitError
from rotemina.drivers.mc68hc11.profile_upload import UNITS_PER_STEP
from rotemina.drivers.mc68hc11.protocol import (
    BeginProfile,
    BeginStream,
    FrameDecoder,
    LoadSegments,
    MoveTo,
    MoveVelocity,
    SerialFrame,
    StreamSegment,
    TriggerProfile,
    WireMessage,
)
from rotemina.sim.messages import AxisName

# The index of the segments of a stream wraps to 0 after this many segments.
_INDEX_COUNT = 256


class StepLimits(NamedTuple):
    """Limits of one axis of a board, in whole steps and steps per second."""

    name: str
    low: int
    high: int
    max_speed: int


class WireGuard:
    """Check of all frames that are written to one board.

    Parameters
    ----------
    limits : mapping of int to StepLimits
        Limits of the axes, by their number on the board.
    read_commands : callable
        Return the latest commands that the board has reported for its axes, steps. Empty if there
        is no report.
    """

    def __init__(
        self, limits: Mapping[int, StepLimits], read_commands: Callable[[], tuple[int, ...]]
    ) -> None:
        self._limits = dict(limits)
        self._read_commands = read_commands
        # Command at the start of each segment of a stream, by segment index. It includes the
        # fractional bits.
        self._stream_starts: dict[int, tuple[int, ...]] = {}
        self._hold_ticks, self._fraction_bits = 1, 0
        self._profile_axis = 0
        self._profile_segments: dict[int, bytes] = {}
        self._checks: dict[int, tuple[type[WireMessage], Callable[..., None]]] = {
            message_class.TYPE: (message_class, check)
            for message_class, check in (
                (MoveTo, self._check_target),
                (MoveVelocity, self._check_velocity),
                (BeginStream, self._begin_stream),
                (StreamSegment, self._check_setpoint),
                (BeginProfile, self._begin_profile),
                (LoadSegments, self._note_segments),
                (TriggerProfile, self._check_profile),
            )
        }

    def check(self, frame: SerialFrame) -> None:
        """Refuse a frame that would move an axis out of its range or too fast.

        Raises
        ------
        LimitError
            If the frame would. The message states the axis, the value and the bound.
        """
        if frame.type in self._checks:
            message_class, check = self._checks[frame.type]
            check(message_class.unpack(frame.payload))

    def _get_limits(self, number: int) -> StepLimits:
        if number not in self._limits:
            raise LimitError(
                "a frame for axis {number}, which the board does not have", number=number
            )
        return self._limits[number]

    def _require_in_range(self, number: int, steps: int) -> None:
        axis = self._get_limits(number)
        if not axis.low <= steps <= axis.high:
            raise LimitError(
                "axis {axis}: a command of {steps} steps is outside its range {low} to {high}",
                axis=AxisName(axis.name),
                steps=steps,
                low=axis.low,
                high=axis.high,
            )

    def _require_speed(self, number: int, speed: int) -> None:
        axis = self._get_limits(number)
        if abs(speed) > axis.max_speed:
            raise LimitError(
                "axis {axis}: a command of {speed} steps/s is above its limit {limit}",
                axis=AxisName(axis.name),
                speed=speed,
                limit=axis.max_speed,
            )

    def _check_target(self, command: MoveTo) -> None:
        self._require_in_range(command.axis, command.target)
        self._require_speed(command.axis, command.max_speed)

    def _check_velocity(self, command: MoveVelocity) -> None:
        self._require_speed(command.axis, command.speed)

    def _begin_stream(self, command: BeginStream) -> None:
        half_step = 1 << command.fraction >> 1
        self._hold_ticks, self._fraction_bits = max(command.hold, 1), command.fraction
        self._stream_starts = {
            0: tuple((steps << command.fraction) + half_step for steps in self._read_commands())
        }

    def _check_setpoint(self, command: StreamSegment) -> None:
        start = self._stream_starts.get(command.index)
        differences = command.unpack_differences()
        if start is None or len(start) != len(differences):
            raise LimitError(
                "set-point {index}: its start position is unknown", index=command.index
            )
        count = command.ticks // self._hold_ticks
        for number, (position, (first, second)) in enumerate(zip(start, differences, strict=True)):
            if first or second:
                for displacement in _find_extremes(count, first, second):
                    self._require_in_range(number, (position + displacement) >> self._fraction_bits)
        self._stream_starts[(command.index + 1) % _INDEX_COUNT] = tuple(
            position + _compute_displacement(count, first, second)
            for position, (first, second) in zip(start, differences, strict=True)
        )

    def _begin_profile(self, command: BeginProfile) -> None:
        self._get_limits(command.axis)
        self._profile_axis, self._profile_segments = command.axis, {}

    def _note_segments(self, command: LoadSegments) -> None:
        self._profile_segments[command.index] = command.packed_segments

    def _check_profile(self, _command: TriggerProfile) -> None:
        commands = self._read_commands()
        self._get_limits(self._profile_axis)
        segment_start = (
            commands[self._profile_axis] * UNITS_PER_STEP + UNITS_PER_STEP // 2 if commands else 0
        )
        for index, packed in sorted(self._profile_segments.items()):
            for segment in LoadSegments(index, packed).unpack_segments():
                for displacement in _find_extremes(segment.ticks, segment.first, segment.second):
                    self._require_in_range(
                        self._profile_axis, (segment_start + displacement) // UNITS_PER_STEP
                    )
                segment_start += _compute_displacement(segment.ticks, segment.first, segment.second)


class LineGuard:
    """Check of all bytes that are written to one line."""

    def __init__(self) -> None:
        self._boards: dict[int, WireGuard] = {}

    def add(self, address: int, guard: WireGuard) -> None:
        """Add the guard of the board with an address."""
        self._boards[address] = guard

    def check(self, data: bytes) -> None:
        """Refuse bytes that would move an axis of a board out of its range or too fast.

        Raises
        ------
        LimitError
            If the bytes would. The message states the axis, the value and the bound.
        """
        for frame in FrameDecoder(is_board=True).feed(data):
            if frame.address in self._boards:
                self._boards[frame.address].check(frame)


def _compute_displacement(count: int, first: int, second: int) -> int:
    """Return the displacement of the command after ``count`` additions."""
    return count * first + count * (count + 1) // 2 * second


def _find_extremes(count: int, first: int, second: int) -> list[int]:
    """Return displacements that include the smallest and the greatest one of a segment."""
    candidates = {1, count}
    if second:
        # The direction of motion reverses here, usually between two additions.
        turning_point = -first // second
        candidates |= {
            min(max(number, 1), count)
            for number in (turning_point - 1, turning_point, turning_point + 1)
        }
    return [_compute_displacement(number, first, second) for number in candidates]
