"""Messages from the host to a board. Positions are integer multiples of the axis resolution."""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from struct import Struct
from typing import NamedTuple, Self

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol.payload import WireMessage

# (first difference, second difference) of each axis.
AxisDifferences = Sequence[tuple[int, int]]
_FIRST_DIFFERENCE_BYTES, _SECOND_DIFFERENCE_BYTES = 4, 3
_QUADRATIC_STRUCT = Struct(">Hii")


@dataclass(frozen=True, slots=True)
class IdentifyBoard(WireMessage, code=0x01, layout="B"):
    """Request for a `BoardIdentity`. It is the first message of a connection."""

    version: int


@dataclass(frozen=True, slots=True)
class StopBoard(WireMessage, code=0x02):
    """Command to one board or all boards: halt and hold every axis.

    Only `ClearFault` ends the stop.
    """


@dataclass(frozen=True, slots=True)
class ClearFault(WireMessage, code=0x03):
    """Command to clear the fault of a board."""


@dataclass(frozen=True, slots=True)
class PollBoard(WireMessage, code=0x04):
    """Request for `Telemetry`. On a shared bus boards send only when they are polled.

    If the poll is a broadcast, each board answers in the slot of its address.
    """


@dataclass(frozen=True, slots=True)
class DescribeAxis(WireMessage, code=0x05, layout="B"):
    """Request for the `AxisDescription` of an axis."""

    axis: int


@dataclass(frozen=True, slots=True)
class SetWatchdog(WireMessage, code=0x06, layout="H"):
    """Command to halt whenever the host has been silent for this time. A board refuses 0."""

    silence_ms: int


@dataclass(frozen=True, slots=True)
class RequestRates(WireMessage, code=0x07):
    """Request for the `BoardRates` that the board sustains on its line."""


@dataclass(frozen=True, slots=True)
class AskKind(WireMessage, code=0x08):
    """Request for the `BoardKind`. Real boards and older virtual ones may refuse it."""


@dataclass(frozen=True, slots=True)
class MoveTo(WireMessage, code=0x10, layout="BiI"):
    """Command to move an axis to a position, in steps, at no more than a speed, in steps/s."""

    axis: int
    target: int
    max_speed: int


@dataclass(frozen=True, slots=True)
class MoveVelocity(WireMessage, code=0x11, layout="BiH"):
    """Command to move an axis at a speed, in steps/s, until the lease expires."""

    axis: int
    speed: int
    lease_ms: int


@dataclass(frozen=True, slots=True)
class StreamSegment(WireMessage, code=0x12, layout="BH"):
    """Segment of a stream: the commands of all axes for a number of ticks.

    ``index`` counts the segments from 0 to 255 and wraps to 0. A board accepts segments only in
    this order. ``axes`` contains the packed :data:`AxisDifferences`. At each change of the command,
    the second difference is added to the first one, and then the first one to the command.
    """

    index: int
    ticks: int
    axes: bytes

    @classmethod
    def from_differences(cls, index: int, ticks: int, axes: AxisDifferences) -> Self:
        """Return the segment with these differences.

        Raises
        ------
        ProtocolError
            If a first difference needs more than 32 bits, or a second one more than 24.
        """
        try:
            packed = b"".join(
                first.to_bytes(_FIRST_DIFFERENCE_BYTES, "big", signed=True)
                + second.to_bytes(_SECOND_DIFFERENCE_BYTES, "big", signed=True)
                for first, second in axes
            )
        except OverflowError as error:
            raise ProtocolError(
                "set-point {index}: differences {values}: 32 and 24 bits at most",
                index=index,
                values=str(list(axes)),
            ) from error
        return cls(index, ticks, packed)

    def unpack_differences(self) -> AxisDifferences:
        """Return the first and the second difference of each axis.

        Raises
        ------
        ProtocolError
            If the payload ends in the middle of an axis.
        """
        size = _FIRST_DIFFERENCE_BYTES + _SECOND_DIFFERENCE_BYTES
        if len(self.axes) % size:
            raise ProtocolError(
                "set-point: {count} bytes: must be {size} per axis", count=len(self.axes), size=size
            )
        parts = (self.axes[start : start + size] for start in range(0, len(self.axes), size))
        return tuple(
            (
                int.from_bytes(part[:_FIRST_DIFFERENCE_BYTES], "big", signed=True),
                int.from_bytes(part[_FIRST_DIFFERENCE_BYTES:], "big", signed=True),
            )
            for part in parts
        )


@dataclass(frozen=True, slots=True)
class BeginStream(WireMessage, code=0x15, layout="IIHB"):
    """Command to start a stream of segments at a time of the board's clock.

    The stream starts at the current positions of the axes. The commands change at the start and
    every ``hold`` ticks after it. The differences have ``fraction`` fractional bits.
    """

    time_us: int
    segments: int
    hold: int
    fraction: int


@dataclass(frozen=True, slots=True)
class SetVoltage(WireMessage, code=0x13, layout="BH"):
    """Command to output a code on the digital-to-analog converter of an axis."""

    axis: int
    code: int


@dataclass(frozen=True, slots=True)
class HomeAxes(WireMessage, code=0x14, layout="B"):
    """Command to home axes. Bit 0 of ``axes`` stands for the first axis."""

    axes: int


@dataclass(frozen=True, slots=True)
class ReadParameter(WireMessage, code=0x20, layout="B"):
    """Request for a `ParameterValue`."""

    index: int


@dataclass(frozen=True, slots=True)
class WriteParameter(WireMessage, code=0x21, layout="Bi"):
    """Command to change a parameter and store it. A board refuses it while an axis moves."""

    index: int
    value: int


@dataclass(frozen=True, slots=True)
class ShowText(WireMessage, code=0x30, layout="BB"):
    """Command to show text on the display, beginning at a row and a column."""

    row: int
    column: int
    text: bytes


@dataclass(frozen=True, slots=True)
class SetTelemetry(WireMessage, code=0x40, layout="HI"):
    """Command to sample periodically, starting at a time of the board's clock; 0 ms ends it.

    On its own line a board sends each sample without a request. On a shared bus it sends the latest
    sample when it is polled.
    """

    period_ms: int
    begin_us: int


@dataclass(frozen=True, slots=True)
class BeginCapture(WireMessage, code=0x41, layout="BHH"):
    """Command to take samples of axes and send them as `CaptureSamples`.

    Bit 0 of ``axes`` stands for the first axis.
    """

    axes: int
    period_us: int
    samples: int


@dataclass(frozen=True, slots=True)
class BeginProfile(WireMessage, code=0x50, layout="BB"):
    """Command to prepare for a profile of one axis with this number of segments."""

    axis: int
    segments: int


class QuadraticSegment(NamedTuple):
    """Segment of a profile: a quadratic path of one axis for a number of ticks.

    At each tick the second difference is added to the first one, and then the first one to the
    command. Both differences are in steps · 2^-16.
    """

    ticks: int
    first: int
    second: int


@dataclass(frozen=True, slots=True)
class LoadSegments(WireMessage, code=0x51, layout="B"):
    """One or two packed segments (:class:`QuadraticSegment`) of a profile.

    ``index`` is the index of the first one in the profile.
    """

    index: int
    packed_segments: bytes

    @classmethod
    def from_segments(cls, index: int, segments: Sequence[QuadraticSegment]) -> Self:
        """Return the message with these segments.

        Raises
        ------
        ProtocolError
            If a number does not fit into its field.
        """
        try:
            return cls(index, b"".join(_QUADRATIC_STRUCT.pack(*segment) for segment in segments))
        except struct.error as error:
            raise ProtocolError(
                "profile, segments {values}: a number does not fit", values=str(list(segments))
            ) from error

    def unpack_segments(self) -> tuple[QuadraticSegment, ...]:
        """Return the segments.

        Raises
        ------
        ProtocolError
            If the payload ends in the middle of a segment, or contains none.
        """
        size = len(self.packed_segments)
        if not size or size % _QUADRATIC_STRUCT.size:
            raise ProtocolError(
                "profile: {size} bytes: must be {quadratic_size} per segment",
                size=size,
                quadratic_size=_QUADRATIC_STRUCT.size,
            )
        return tuple(
            map(QuadraticSegment._make, _QUADRATIC_STRUCT.iter_unpack(self.packed_segments))
        )


@dataclass(frozen=True, slots=True)
class ArmProfile(WireMessage, code=0x52, layout="BH"):
    """Command to arm the profile, so that it waits for its trigger.

    ``trigger`` is 0 for `TriggerProfile`, or 1 for the board's button. ``check`` is the CRC over
    the joined payloads of all `LoadSegments`.
    """

    trigger: int
    check: int


@dataclass(frozen=True, slots=True)
class TriggerProfile(WireMessage, code=0x53):
    """Command to start the armed profile."""


@dataclass(frozen=True, slots=True)
class AbortProfile(WireMessage, code=0x54):
    """Command to delete the profile, and to halt its axis if it runs. This is not a fault."""
