"""Messages from a board to its host. Positions are integer multiples of the axis resolution."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol.payload import WireMessage

# (reading, command) of each axis, steps.
AxisPairs = Sequence[tuple[int, int]]
AXIS_BYTES = 5
_READING_LIMIT = 1 << 23
_DEVIATION_LIMIT = 1 << 15
_INPUT_BITS = 12


@dataclass(frozen=True, slots=True)
class FrameDone(WireMessage, code=0x80, layout="B"):
    """Answer to a frame that the board has executed. A repeated frame is not executed again."""

    number: int


@dataclass(frozen=True, slots=True)
class FrameRefused(WireMessage, code=0x81, layout="BB"):
    """Answer to a frame that was not executed, with the reason."""

    number: int
    reason: int


@dataclass(frozen=True, slots=True)
class BoardIdentity(WireMessage, code=0x82, layout="BHBIHH"):
    """Identity of a board.

    ``axes`` and ``parameters`` are numbers of axes and parameters, ``abilities`` are bits of
    `BoardAbility`, and ``fingerprint`` is the CRC over all parameters.
    """

    version: int
    abilities: int
    axes: int
    baud: int
    parameters: int
    fingerprint: int
    name: bytes


@dataclass(frozen=True, slots=True)
class AxisDescription(WireMessage, code=0x83, layout="BBBBHbii"):
    """Description of an axis.

    ``kind`` is the kind of actuator, and ``role`` is the stage. The resolution is
    ``mantissa · 10^exponent`` m or rad. ``low`` and ``high`` are the ends of the range, steps.
    """

    axis: int
    kind: int
    role: int
    unit: int
    mantissa: int
    exponent: int
    low: int
    high: int


@dataclass(frozen=True, slots=True)
class Telemetry(WireMessage, code=0x84, layout="IBBBB"):
    """Sample of the axes: the readings, and the deviations of the commands from them.

    The readings are taken at ``time_us``, just before the command of the same instant takes effect.
    The deviations refer to this new command. From bit 0 on, ``switches`` contains the low and the
    high limit switch of each axis, then both buttons. ``expected`` is the index of the next segment
    of a stream, or 0 while no stream plays. ``axes`` contains the packed
    :data:`AxisPairs`.
    """

    time_us: int
    state: int
    fault: int
    switches: int
    next_segment_index: int
    axes: bytes

    @classmethod
    def from_samples(
        cls, time_us: int, state: int, fault: int, switches: int, expected: int, axes: AxisPairs
    ) -> Self:
        """Return the telemetry for readings and commands, steps. Large deviations are clipped.

        Raises
        ------
        ProtocolError
            If a reading needs more than 24 bits.
        """
        packed = b""
        for reading, command in axes:
            if not -_READING_LIMIT <= reading < _READING_LIMIT:
                raise ProtocolError(
                    "telemetry: a reading of {reading} steps: 24 bits at most", reading=reading
                )
            deviation = min(max(command - reading, -_DEVIATION_LIMIT), _DEVIATION_LIMIT - 1)
            packed += reading.to_bytes(3, "big", signed=True)
            packed += deviation.to_bytes(2, "big", signed=True)
        return cls(time_us, state, fault, switches, expected, packed)

    def unpack_samples(self) -> AxisPairs:
        """Return (reading, command) of each axis, steps.

        Raises
        ------
        ProtocolError
            If the payload ends in the middle of an axis.
        """
        if len(self.axes) % AXIS_BYTES:
            raise ProtocolError(
                "telemetry: {count} bytes: must be {axis_bytes} per axis",
                count=len(self.axes),
                axis_bytes=AXIS_BYTES,
            )
        pairs = []
        for start in range(0, len(self.axes), AXIS_BYTES):
            reading = int.from_bytes(self.axes[start : start + 3], "big", signed=True)
            deviation = int.from_bytes(self.axes[start + 3 : start + 5], "big", signed=True)
            pairs.append((reading, reading + deviation))
        return tuple(pairs)


@dataclass(frozen=True, slots=True)
class OperatorInputs(WireMessage, code=0x88, layout="B"):
    """Pressed buttons, one per bit, and joystick readings.

    Two 12-bit readings are packed into three bytes.
    """

    buttons: int
    packed_readings: bytes

    @classmethod
    def from_readings(cls, buttons: int, readings: Sequence[int]) -> Self:
        """Return the message with buttons and up to eight readings, 0 to 4095.

        Raises
        ------
        ProtocolError
            If a reading needs more than 12 bits.
        """
        packed_bits = 0
        for reading in readings:
            if not 0 <= reading < 1 << _INPUT_BITS:
                raise ProtocolError(
                    "inputs: a reading of {reading}: must be 0 to 4095", reading=reading
                )
            packed_bits = packed_bits << _INPUT_BITS | reading
        byte_count = (len(readings) * _INPUT_BITS + 7) // 8
        packed_bits <<= byte_count * 8 - len(readings) * _INPUT_BITS
        return cls(buttons, packed_bits.to_bytes(byte_count, "big"))

    def unpack_readings(self) -> tuple[int, ...]:
        """Return the readings, 0 to 4095."""
        count = len(self.packed_readings) * 8 // _INPUT_BITS
        packed_bits = int.from_bytes(self.packed_readings, "big")
        packed_bits >>= len(self.packed_readings) * 8 - count * _INPUT_BITS
        shifts = range((count - 1) * _INPUT_BITS, -1, -_INPUT_BITS)
        return tuple(packed_bits >> shift & ((1 << _INPUT_BITS) - 1) for shift in shifts)


@dataclass(frozen=True, slots=True)
class ParameterValue(WireMessage, code=0x86, layout="Bi"):
    """Value of a parameter."""

    index: int
    value: int


@dataclass(frozen=True, slots=True)
class CaptureSamples(WireMessage, code=0x85, layout="H"):
    """Consecutive samples of a capture. ``begin`` is the number of the first one.

    Each sample contains the low 16 bits of the position of each captured axis.
    """

    first_number: int
    samples: bytes


@dataclass(frozen=True, slots=True)
class BoardRates(WireMessage, code=0x87, layout="HHHHHH"):
    """Maximum rates, Hz, that the board sustains at its baud rate and on its type of line.

    ``capture_one`` and ``capture_three`` are the sampling rates of a capture of one and of three
    axes, and ``segments`` is the rate of the segments of a stream. ``tick`` is the fixed rate of
    the control ticks.
    """

    telemetry: int
    telemetry_while_capturing: int
    capture_one: int
    capture_three: int
    segments: int
    tick: int


@dataclass(frozen=True, slots=True)
class BoardKind(WireMessage, code=0x89):
    """Kind of the board: `VIRTUAL_KIND` for a virtual board, anything else for a real one."""

    kind: bytes
