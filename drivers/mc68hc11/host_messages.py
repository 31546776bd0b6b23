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
class Identify(Message, code=0x01, layout="B"):
    """Who is there? The first thing that is asked; the answer is an `Identity`."""

    version: int


@dataclass(frozen=True, slots=True)
class Stop(Message, code=0x02):
    """Halt every axis and hold; also to all boards at once. Nothing clears it but `ClearFault`."""


@dataclass(frozen=True, slots=True)
class ClearFault(Message, code=0x03):
    """Forget the first reason of a halt."""


@dataclass(frozen=True, slots=True)
class Poll(Message, code=0x04):
    """Tell where you are: the answer is a `Telemetry`. On a shared bus boards speak when polled.

    To all boards at once, each answers in the slot of its address.
    """


@dataclass(frozen=True, slots=True)
class DescribeAxis(Message, code=0x05, layout="B"):
    """What is this axis? The answer is an `AxisDescription`."""

    axis: int


@dataclass(frozen=True, slots=True)
class Watch(Message, code=0x06, layout="H"):
    """Halt when the host is silent for this long; 0 is refused."""

    silence_ms: int


@dataclass(frozen=True, slots=True)
class AskRates(Message, code=0x07):
    """What can this line carry? The answer is `Rates`."""


@dataclass(frozen=True, slots=True)
class AskKind(Message, code=0x08):
    """Are you a program? The answer is a `BoardKind`; real boards and older ones refuse."""


@dataclass(frozen=True, slots=True)
class MoveTo(Message, code=0x10, layout="BiI"):
    """Go to a position, no faster than this."""

    axis: int
    target: int
    most_speed: int


@dataclass(frozen=True, slots=True)
class MoveVelocity(Message, code=0x11, layout="BiH"):
    """Go on at this speed, steps of resolution per second, for as long as the lease runs."""

    axis: int
    speed: int
    lease_ms: int


@dataclass(frozen=True, slots=True)
class SetPoint(Message, code=0x12, layout="BH"):
    """A segment of a stream, all axes at once: for so many ticks their commands change like this.

    ``index`` counts segments from 0, over 255 on to 0 again; a board takes them in this order only.
    ``axes``: :data:`Differences`, packed one after the other. At each addition the first difference
    grows by the second one, and the command by the first.
    """

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
class BeginStream(Message, code=0x15, layout="IIHB"):
    """A stream of this many segments begins at this time of the board, from where the axes stand.

    Commands change at its begin and every ``hold`` ticks from then on; differences have
    ``fraction`` binary digits behind the point of a step.
    """

    time_us: int
    segments: int
    hold: int
    fraction: int


@dataclass(frozen=True, slots=True)
class SetVoltage(Message, code=0x13, layout="BH"):
    """Put out this code of the digital-to-analog converter."""

    axis: int
    code: int


@dataclass(frozen=True, slots=True)
class Home(Message, code=0x14, layout="B"):
    """Find the limit switches of these axes, bit by bit."""

    axes: int


@dataclass(frozen=True, slots=True)
class ReadParameter(Message, code=0x20, layout="B"):
    """What is this parameter? The answer is a `Parameter`."""

    index: int


@dataclass(frozen=True, slots=True)
class WriteParameter(Message, code=0x21, layout="Bi"):
    """Take this value, and keep it without power; refused while an axis moves."""

    index: int
    value: int


@dataclass(frozen=True, slots=True)
class ShowText(Message, code=0x30, layout="BB"):
    """Show text from this place of the display on."""

    row: int
    column: int
    text: bytes


@dataclass(frozen=True, slots=True)
class SetTelemetry(Message, code=0x40, layout="HI"):
    """Take a sample every so often, the first at this time of the board; 0 ends it.

    On two lines each is sent unasked, on a shared bus the latest one when polled.
    """

    period_ms: int
    begin_us: int


@dataclass(frozen=True, slots=True)
class Capture(Message, code=0x41, layout="BHH"):
    """Take this many samples of these axes, bit by bit, and send them as `Captured`."""

    axes: int
    period_us: int
    samples: int


@dataclass(frozen=True, slots=True)
class BeginProfile(Message, code=0x50, layout="BB"):
    """An on-board motion of an axis, of this many segments, begins."""

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
class Segments(Message, code=0x51, layout="B"):
    """One or two segments of a profile, from this index on: :class:`Quadratic`, packed."""

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
class ArmProfile(Message, code=0x52, layout="BH"):
    """Wait for the trigger: 0 a frame of the host, 1 the board's own button.

    ``check`` is the CRC of all segments' payloads, one after the other.
    """

    trigger: int
    check: int


@dataclass(frozen=True, slots=True)
class TriggerProfile(Message, code=0x53):
    """Go."""


@dataclass(frozen=True, slots=True)
class AbortProfile(Message, code=0x54):
    """Forget the profile, or halt where it is; no fault."""
