"""What a board says to its host. Positions are steps of resolution, times microseconds."""

from dataclasses import dataclass
from struct import Struct

from rotemina.drivers.mc68hc11.message import Message


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
