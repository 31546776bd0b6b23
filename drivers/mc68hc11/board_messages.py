"""What a board says to its host. Positions are steps of resolution, times microseconds."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.sim.messages import message

Axes = Sequence[tuple[int, int]]  # reading and command of each axis, steps
AXIS_BYTES = 5
_READING = 1 << 23
_DEVIATION = 1 << 15
_READING_BITS = 12


@dataclass(frozen=True, slots=True)
class Done(Message, code=0x80, layout="B"):
    """The frame of this number was executed, now or before."""

    number: int


@dataclass(frozen=True, slots=True)
class Refused(Message, code=0x81, layout="BB"):
    """The frame of this number was not executed."""

    number: int
    reason: int


@dataclass(frozen=True, slots=True)
class Identity(Message, code=0x82, layout="BHBIHH"):
    """Protocol version, abilities, axes, baud, what is kept in parameters, and a name."""

    version: int
    abilities: int
    axes: int
    baud: int
    parameters: int
    fingerprint: int
    name: bytes


@dataclass(frozen=True, slots=True)
class AxisDescription(Message, code=0x83, layout="BBBBHbii"):
    """An axis: kind, role, resolution ``mantissa · 10^exponent`` m or rad, ends of its range."""

    axis: int
    kind: int
    role: int
    unit: int
    mantissa: int
    exponent: int
    low: int
    high: int


@dataclass(frozen=True, slots=True)
class Telemetry(Message, code=0x84, layout="IBBBB"):
    """One sample of the axes: readings, and how far the commands that acted are from them.

    It was taken at ``time_us``, before the command of the same instant acts; what is told is the
    command that acts from then on. ``switches``: limit switches low and high of each axis, then
    both buttons, from bit 0 on; ``expected``: the index of the segment that a stream takes next, 0
    while none plays; ``axes``: :data:`Axes`, packed one after the other.
    """

    time_us: int
    state: int
    fault: int
    switches: int
    expected: int
    axes: bytes

    @classmethod
    def of(
        cls, time_us: int, state: int, fault: int, switches: int, expected: int, axes: Axes
    ) -> Self:
        """Return the telemetry of readings and commands, steps; a deviation too large is clipped.

        Raises
        ------
        ProtocolError
            If a reading takes more than 24 bits.
        """
        packed = b""
        for reading, command in axes:
            if not -_READING <= reading < _READING:
                raise ProtocolError(
                    message(
                        "engine", "telemetry: a reading of {reading} steps: 24 bits at most"
                    ).fill(reading=reading)
                )
            deviation = min(max(command - reading, -_DEVIATION), _DEVIATION - 1)
            packed += reading.to_bytes(3, "big", signed=True)
            packed += deviation.to_bytes(2, "big", signed=True)
        return cls(time_us, state, fault, switches, expected, packed)

    def samples(self) -> Axes:
        """Return (reading, command) of each axis, steps.

        Raises
        ------
        ProtocolError
            If the payload ends in the middle of an axis.
        """
        if len(self.axes) % AXIS_BYTES:
            raise ProtocolError(
                message("engine", "telemetry: {count} bytes: must be {axis_bytes} an axis").fill(
                    count=len(self.axes), axis_bytes=AXIS_BYTES
                )
            )
        found = []
        for begin in range(0, len(self.axes), AXIS_BYTES):
            reading = int.from_bytes(self.axes[begin : begin + 3], "big", signed=True)
            deviation = int.from_bytes(self.axes[begin + 3 : begin + 5], "big", signed=True)
            found.append((reading, reading + deviation))
        return tuple(found)


@dataclass(frozen=True, slots=True)
class Inputs(Message, code=0x88, layout="B"):
    """What the operator holds: buttons, bit by bit, and readings of 12 bits, two in three bytes."""

    buttons: int
    packed_readings: bytes

    @classmethod
    def of(cls, buttons: int, readings: Sequence[int]) -> Self:
        """Return the report of buttons and up to eight readings, 0 to 4095.

        Raises
        ------
        ProtocolError
            If a reading takes more than 12 bits.
        """
        number = 0
        for reading in readings:
            if not 0 <= reading < 1 << _READING_BITS:
                raise ProtocolError(
                    message("engine", "inputs: a reading of {reading}: must be 0 to 4095").fill(
                        reading=reading
                    )
                )
            number = number << _READING_BITS | reading
        count = (len(readings) * _READING_BITS + 7) // 8
        number <<= count * 8 - len(readings) * _READING_BITS
        return cls(buttons, number.to_bytes(count, "big"))

    def readings(self) -> tuple[int, ...]:
        """Return the readings, 0 to 4095."""
        count = len(self.packed_readings) * 8 // _READING_BITS
        number = int.from_bytes(self.packed_readings, "big")
        number >>= len(self.packed_readings) * 8 - count * _READING_BITS
        places = range((count - 1) * _READING_BITS, -1, -_READING_BITS)
        return tuple(number >> place & ((1 << _READING_BITS) - 1) for place in places)


@dataclass(frozen=True, slots=True)
class Parameter(Message, code=0x86, layout="Bi"):
    """The value of a parameter."""

    index: int
    value: int


@dataclass(frozen=True, slots=True)
class Captured(Message, code=0x85, layout="H"):
    """Samples from this one on: the low 16 bits of each captured axis, sample by sample."""

    begin: int
    samples: bytes


@dataclass(frozen=True, slots=True)
class Rates(Message, code=0x87, layout="HHHHHH"):
    """The greatest rates, Hz, that the board keeps up at its baud rate and on its kind of line.

    Of telemetry alone and during a capture; of a capture of one axis and of three; of segments of a
    stream; and of its control ticks, which are what they are.
    """

    telemetry: int
    telemetry_while_capturing: int
    capture_one: int
    capture_three: int
    segments: int
    tick: int


@dataclass(frozen=True, slots=True)
class BoardKind(Message, code=0x89):
    """What the board is: `VIRTUAL` of a program, anything else of a real board."""

    kind: bytes
