"""What a board and its host say to each other. Pure; ``docs/protocol.md`` is the contract.

Numbers are big-endian, as the MC68HC11 has them. Positions are whole steps of an axis' resolution,
times whole microseconds of the board's own clock.
"""

import struct
from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import IntEnum, IntFlag
from struct import Struct
from typing import ClassVar, Self

from rotemina.drivers.errors import ProtocolError

VERSION = 1
LCD_COLUMNS, LCD_ROWS = 20, 2
SEGMENTS = 16  # of an on-board profile
AXES = 3  # of one board


class Fault(IntEnum):
    """Why a board halted; the first reason stays until it is cleared."""

    NONE = 0
    STOPPED = 1
    WATCHDOG = 2
    LIMIT_SWITCH = 3
    SOFT_LIMIT = 4
    SENSOR = 5
    BROWN_OUT = 6
    RESET = 7
    LATE_SETPOINT = 8
    PROFILE = 9


class Refusal(IntEnum):
    """Why a board did not do what a frame asked."""

    UNKNOWN_TYPE = 1
    WRONG_LENGTH = 2
    BAD_VALUE = 3
    FAULTY = 4
    NOT_HOMED = 5
    BUSY = 6
    QUEUE_FULL = 7
    NOT_ABLE = 8


class State(IntFlag):
    """What a board is doing, bit by bit."""

    MOVING = 0x01
    PLAYING = 0x02
    HOMING = 0x04
    FAULT = 0x08
    CAPTURING = 0x10
    ARMED = 0x20
    POSITION_UNKNOWN = 0x40


class Ability(IntFlag):
    """What a board can do beyond telling its position and stopping."""

    MOVE = 0x0001
    VELOCITY = 0x0002
    HOMING = 0x0004
    SETPOINTS = 0x0008
    DAC = 0x0010
    CAPTURE = 0x0020
    PROFILE = 0x0040
    JOYSTICK = 0x0080
    DISPLAY = 0x0100
    PARAMETERS = 0x0200
    HALF_DUPLEX = 0x0400


class Message:
    """Something that fits into the payload of one frame.

    ``TYPE`` is the frame's, ``LAYOUT`` how the fields are packed; a last field of bytes takes
    what is left of the payload.
    """

    TYPE: ClassVar[int]
    LAYOUT: ClassVar[Struct]
    __slots__ = ()

    def packed(self) -> bytes:
        """Return the payload.

        Raises
        ------
        ProtocolError
            If a number does not fit where it goes.
        """
        names = [field.name for field in fields(self)]  # type: ignore[arg-type]
        values = [getattr(self, name) for name in names]
        tail = values.pop() if self._has_tail() else b""
        try:
            return self.LAYOUT.pack(*values) + tail
        except struct.error as error:
            raise ProtocolError(f"{self}: a number does not fit: {error}") from error

    @classmethod
    def unpacked(cls, payload: bytes) -> Self:
        """Return the message that a payload holds.

        Raises
        ------
        ProtocolError
            If it is none of this type.
        """
        size, tail = cls.LAYOUT.size, cls._has_tail()
        if len(payload) < size or (len(payload) > size and not tail):
            more = " or more" if tail else ""
            raise ProtocolError(
                f"{cls.__name__}: a payload of {len(payload)} bytes: must be {size}{more}"
            )
        numbers = cls.LAYOUT.unpack_from(payload)
        values = (*numbers, payload[size:]) if tail else numbers
        return cls(*values)

    @classmethod
    def _has_tail(cls) -> bool:
        own = fields(cls)  # type: ignore[arg-type]
        return bool(own) and own[-1].type is bytes


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
    """Be there at this time of the board; all three axes at once."""

    TYPE = 0x12
    LAYOUT = Struct(">Iiii")

    time_us: int
    first: int
    second: int
    third: int


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
    """Tell where you are every so often without being asked; 0 ends it. Not on a shared bus."""

    TYPE = 0x40
    LAYOUT = Struct(">H")

    period_ms: int


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


@dataclass(frozen=True, slots=True)
class Segment(Message):
    """One segment: ``x = x0 + c1 τ + c2 τ² + c3 τ³`` with τ from 0 to 1 over its duration.

    x0 is where the one before ended.
    """

    TYPE = 0x51
    LAYOUT = Struct(">BIiii")

    index: int
    duration_us: int
    c1: int
    c2: int
    c3: int


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


@dataclass(frozen=True, slots=True)
class Done(Message):
    """The frame of this number was executed, now or before."""

    TYPE = 0x80
    LAYOUT = Struct(">B")

    number: int


@dataclass(frozen=True, slots=True)
class Refused(Message):
    """The frame of this number was not executed."""

    TYPE = 0x81
    LAYOUT = Struct(">BB")

    number: int
    reason: int


@dataclass(frozen=True, slots=True)
class Identity(Message):
    """Protocol version, abilities, axes, baud, what is kept in parameters, and a name."""

    TYPE = 0x82
    LAYOUT = Struct(">BHBIHH")

    version: int
    abilities: int
    axes: int
    baud: int
    parameters: int
    fingerprint: int
    name: bytes


@dataclass(frozen=True, slots=True)
class AxisDescription(Message):
    """An axis: kind, role, resolution ``mantissa · 10^exponent`` m or rad, ends of its range."""

    TYPE = 0x83
    LAYOUT = Struct(">BBBBHbii")

    axis: int
    kind: int
    role: int
    unit: int
    mantissa: int
    exponent: int
    low: int
    high: int


@dataclass(frozen=True, slots=True)
class Telemetry(Message):
    """Where the axes are, what the board is doing, its switches and its joystick.

    ``switches``: limit switches low and high of each axis, then both buttons, from bit 0 on;
    ``joystick``: three readings of 12 bits, one after the other, or nothing.
    """

    TYPE = 0x84
    LAYOUT = Struct(">IBBBiii")

    time_us: int
    state: int
    fault: int
    switches: int
    first: int
    second: int
    third: int
    joystick: bytes


@dataclass(frozen=True, slots=True)
class Parameter(Message):
    """The value of a parameter."""

    TYPE = 0x86
    LAYOUT = Struct(">Bi")

    index: int
    value: int


@dataclass(frozen=True, slots=True)
class Captured(Message):
    """Samples from this one on: the low 16 bits of each captured axis, sample by sample."""

    TYPE = 0x85
    LAYOUT = Struct(">H")

    begin: int
    samples: bytes


@dataclass(frozen=True, slots=True)
class Rates(Message):
    """The greatest rates, Hz, that the board keeps up at its baud rate and on its kind of line.

    Of telemetry alone and during a capture; of a capture of one axis and of three.
    """

    TYPE = 0x87
    LAYOUT = Struct(">HHHH")

    telemetry: int
    telemetry_while_capturing: int
    capture_one: int
    capture_three: int


_ALL: tuple[type[Message], ...] = (
    Identify,
    Stop,
    ClearFault,
    Poll,
    DescribeAxis,
    Watch,
    AskRates,
    MoveTo,
    MoveVelocity,
    SetPoint,
    SetVoltage,
    Home,
    ReadParameter,
    WriteParameter,
    ShowText,
    SetTelemetry,
    Capture,
    BeginProfile,
    Segment,
    ArmProfile,
    TriggerProfile,
    AbortProfile,
    Done,
    Refused,
    Identity,
    AxisDescription,
    Telemetry,
    Parameter,
    Captured,
    Rates,
)
MESSAGES: Mapping[int, type[Message]] = {one.TYPE: one for one in _ALL}


def message_of(type_: int, payload: bytes) -> Message:
    """Return the message of a frame's type and payload.

    Raises
    ------
    ProtocolError
        If there is no such type, or the payload is none of it.
    """
    known = MESSAGES.get(type_)
    if known is None:
        raise ProtocolError(f"frame of type 0x{type_:02X}: no message of this protocol")
    return known.unpacked(payload)
