"""What a host says to a board. Positions are steps of resolution, times microseconds."""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from struct import Struct
from typing import NamedTuple, Self

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.sim.messages import message

Differences = Sequence[tuple[int, int]]  # first and second of each axis
_FIRST, _SECOND = 4, 3  # bytes
_QUADRATIC = Struct(">Hii")


@dataclass(frozen=True, slots=True)
class Identify(Message):
    """Who is there? The first thing that is asked; the answer is an `Identity`."""

    TYPE = 0x01
    LAYOUT = Struct(">B")

    version: int


@dataclass(frozen=True, slots=True)
class Stop(Message):
    """Halt every axis and hold; also to all boards at once. Nothing clears it but `ClearFault`."""

    TYPE = 0x02
    LAYOUT = Struct(">")


@dataclass(frozen=True, slots=True)
class ClearFault(Message):
    """Forget the first reason of a halt."""

    TYPE = 0x03
    LAYOUT = Struct(">")


@dataclass(frozen=True, slots=True)
class Poll(Message):
    """Tell where you are: the answer is a `Telemetry`. On a shared bus boards speak when polled.

    To all boards at once, each answers in the slot of its address.
    """

    TYPE = 0x04
    LAYOUT = Struct(">")


@dataclass(frozen=True, slots=True)
class DescribeAxis(Message):
    """What is this axis? The answer is an `AxisDescription`."""

    TYPE = 0x05
    LAYOUT = Struct(">B")

    axis: int


@dataclass(frozen=True, slots=True)
class Watch(Message):
    """Halt when the host is silent for this long; 0 is refused."""

    TYPE = 0x06
    LAYOUT = Struct(">H")

    silence_ms: int


@dataclass(frozen=True, slots=True)
class AskRates(Message):
    """What can this line carry? The answer is `Rates`."""

    TYPE = 0x07
    LAYOUT = Struct(">")


@dataclass(frozen=True, slots=True)
class MoveTo(Message):
    """Go to a position, no faster than this."""

    TYPE = 0x10
    LAYOUT = Struct(">BiI")

    axis: int
    target: int
    most_speed: int


@dataclass(frozen=True, slots=True)
class MoveVelocity(Message):
    """Go on at this speed, steps of resolution per second, for as long as the lease runs."""

    TYPE = 0x11
    LAYOUT = Struct(">BiH")

    axis: int
    speed: int
    lease_ms: int


@dataclass(frozen=True, slots=True)
class SetPoint(Message):
    """A segment of a stream, all axes at once: for so many ticks their commands change like this.

    ``index`` counts segments from 0, over 255 on to 0 again; a board takes them in this order only.
    ``axes``: :data:`Differences`, packed one after the other. At each addition the first difference
    grows by the second one, and the command by the first.
    """

    TYPE = 0x12
    LAYOUT = Struct(">BH")

    index: int
    ticks: int
    axes: bytes

    @classmethod
    def of(cls, index: int, ticks: int, axes: Differences) -> Self:
        """Return the segment with these differences.

        Raises
        ------
        ProtocolError
            If a first difference takes more than 32 bits, or a second one more than 24.
        """
        try:
            packed = b"".join(
                first.to_bytes(_FIRST, "big", signed=True)
                + second.to_bytes(_SECOND, "big", signed=True)
                for first, second in axes
            )
        except OverflowError as error:
            raise ProtocolError(
                message(
                    "engine", "set-point {index}: differences {values}: 32 and 24 bits at most"
                ).fill(index=index, values=str(list(axes)))
            ) from error
        return cls(index, ticks, packed)

    def differences(self) -> Differences:
        """Return the first and the second difference of each axis.

        Raises
        ------
        ProtocolError
            If the payload ends in the middle of an axis.
        """
        size = _FIRST + _SECOND
        if len(self.axes) % size:
            raise ProtocolError(
                message("engine", "set-point: {count} bytes: must be {size} an axis").fill(
                    count=len(self.axes), size=size
                )
            )
        parts = (self.axes[begin : begin + size] for begin in range(0, len(self.axes), size))
        return tuple(
            (
                int.from_bytes(part[:_FIRST], "big", signed=True),
                int.from_bytes(part[_FIRST:], "big", signed=True),
            )
            for part in parts
        )


@dataclass(frozen=True, slots=True)
class BeginStream(Message):
    """A stream of this many segments begins at this time of the board, from where the axes stand.

    Commands change at its begin and every ``hold`` ticks from then on; differences have
    ``fraction`` binary digits behind the point of a step.
    """

    TYPE = 0x15
    LAYOUT = Struct(">IIHB")

    time_us: int
    segments: int
    hold: int
    fraction: int


@dataclass(frozen=True, slots=True)
class SetVoltage(Message):
    """Put out this code of the digital-to-analog converter."""

    TYPE = 0x13
    LAYOUT = Struct(">BH")

    axis: int
    code: int


@dataclass(frozen=True, slots=True)
class Home(Message):
    """Find the limit switches of these axes, bit by bit."""

    TYPE = 0x14
    LAYOUT = Struct(">B")

    axes: int


@dataclass(frozen=True, slots=True)
class ReadParameter(Message):
    """What is this parameter? The answer is a `Parameter`."""

    TYPE = 0x20
    LAYOUT = Struct(">B")

    index: int


@dataclass(frozen=True, slots=True)
class WriteParameter(Message):
    """Take this value, and keep it without power; refused while an axis moves."""

    TYPE = 0x21
    LAYOUT = Struct(">Bi")

    index: int
    value: int


@dataclass(frozen=True, slots=True)
class ShowText(Message):
    """Show text from this place of the display on."""

    TYPE = 0x30
    LAYOUT = Struct(">BB")

    row: int
    column: int
    text: bytes


@dataclass(frozen=True, slots=True)
class SetTelemetry(Message):
    """Take a sample every so often, the first at this time of the board; 0 ends it.

    On two lines each is sent unasked, on a shared bus the latest one when polled.
    """

    TYPE = 0x40
    LAYOUT = Struct(">HI")

    period_ms: int
    begin_us: int


@dataclass(frozen=True, slots=True)
class Capture(Message):
    """Take this many samples of these axes, bit by bit, and send them as `Captured`."""

    TYPE = 0x41
    LAYOUT = Struct(">BHH")

    axes: int
    period_us: int
    samples: int


@dataclass(frozen=True, slots=True)
class BeginProfile(Message):
    """An on-board motion of an axis, of this many segments, begins."""

    TYPE = 0x50
    LAYOUT = Struct(">BB")

    axis: int
    segments: int


class Quadratic(NamedTuple):
    """A segment of a profile: what one axis does over so many ticks, from where it is.

    At each tick the first difference grows by the second one, and the command by the first: steps
    · 2^-16.
    """

    ticks: int
    first: int
    second: int


@dataclass(frozen=True, slots=True)
class Segments(Message):
    """One or two segments of a profile, from this index on: :class:`Quadratic`, packed."""

    TYPE = 0x51
    LAYOUT = Struct(">B")

    index: int
    packed_segments: bytes

    @classmethod
    def of(cls, index: int, segments: Sequence[Quadratic]) -> Self:
        """Return the message that tells some segments.

        Raises
        ------
        ProtocolError
            If a number does not fit where it goes.
        """
        try:
            return cls(index, b"".join(_QUADRATIC.pack(*one) for one in segments))
        except struct.error as error:
            raise ProtocolError(
                message("engine", "profile, segments {values}: a number does not fit").fill(
                    values=str(list(segments))
                )
            ) from error

    def segments(self) -> tuple[Quadratic, ...]:
        """Return the segments.

        Raises
        ------
        ProtocolError
            If the payload ends in the middle of one, or has none.
        """
        size = len(self.packed_segments)
        if not size or size % _QUADRATIC.size:
            raise ProtocolError(
                message("engine", "profile: {size} bytes: must be {quadratic_size} a segment").fill(
                    size=size, quadratic_size=_QUADRATIC.size
                )
            )
        return tuple(map(Quadratic._make, _QUADRATIC.iter_unpack(self.packed_segments)))


@dataclass(frozen=True, slots=True)
class ArmProfile(Message):
    """Wait for the trigger: 0 a frame of the host, 1 the board's own button.

    ``check`` is the CRC of all segments' payloads, one after the other.
    """

    TYPE = 0x52
    LAYOUT = Struct(">BH")

    trigger: int
    check: int


@dataclass(frozen=True, slots=True)
class TriggerProfile(Message):
    """Go."""

    TYPE = 0x53
    LAYOUT = Struct(">")


@dataclass(frozen=True, slots=True)
class AbortProfile(Message):
    """Forget the profile, or halt where it is; no fault."""

    TYPE = 0x54
    LAYOUT = Struct(">")
