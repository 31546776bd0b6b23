"""Capacity of a serial line: data rates that a board may offer, and the latency of a stop.

All loads are counted in bytes on the wire, ten bits each. On a shared bus each frame is followed
by a slot in which only the host may start a frame. So a stop waits for at most one frame.

A telemetry frame has 31 bytes, and every fourth one is followed by a 14-byte frame of inputs. A
capture frame holds up to 11 samples of one axis, or 3 samples of three axes.
"""

from dataclasses import dataclass
from math import ceil
from typing import NamedTuple

from rotemina.drivers.mc68hc11.protocol import (
    AXES_PER_BOARD,
    AXIS_BYTES,
    MAX_FRAME_BYTES,
    BoardRates,
    CaptureSamples,
    OperatorInputs,
    Telemetry,
    WireMessage,
)

# A start bit, eight data bits and a stop bit.
BITS_PER_BYTE = 10
BAUD_RATES = (125_000, 9_600)
# Address, number, type, CRC (two bytes), stuffing and the final zero.
_OVERHEAD_BYTES = 7
# Each frame of a board begins with a zero.
_LEADING_ZERO_BYTES = 1
# Three 12-bit readings of the joystick's potentiometers.
_INPUT_READINGS_BYTES = 5
# One frame of inputs is sent after this many telemetry frames.
_TELEMETRY_FRAMES_PER_INPUTS = 4
_CAPTURED_VALUE_BYTES = 2
# Silence after each frame on a shared bus.
_SLOT_BYTES = 3
_BOARDS_ON_BUS = 2
_MAX_LOAD = 0.95
# Control ticks of the chip at E = 4 MHz.
DEFAULT_TICK_HZ = 2000
# Rows of a trajectory in one segment of a stream.
ROWS_PER_SEGMENT = 2


class _RateSet(NamedTuple):
    telemetry_hz: int
    telemetry_while_capturing_hz: int
    capture_one_axis_hz: int
    capture_three_axes_hz: int


# Candidates from fast to slow. A board offers the first rates that fit the line.
_CANDIDATE_RATES = (
    _RateSet(200, 50, 2000, 1000),
    _RateSet(100, 25, 1000, 500),
    _RateSet(50, 10, 500, 200),
    _RateSet(20, 10, 200, 100),
    _RateSet(10, 5, 100, 50),
    _RateSet(5, 2, 100, 25),
    _RateSet(4, 2, 50, 25),
)
# The chip sustains these rates at E = 2 MHz, with control ticks of 1 kHz. See
# ``firmware/chip_load.py``.
_CHIP_TICK_HZ, _CHIP_RATES = 1000, _RateSet(100, 25, 1000, 250)


@dataclass(frozen=True, slots=True)
class LineCapacity:
    """Capacity of a serial line.

    If ``half_duplex`` is set, both directions and both boards share the line.
    """

    baud: int
    half_duplex: bool = False

    @property
    def bytes_per_s(self) -> float:
        """Bytes per second that the line carries in one direction."""
        return self.baud / BITS_PER_BYTE

    def compute_duration_s(self, count: int) -> float:
        """Return the time that a number of bytes takes on the line, s."""
        return count / self.bytes_per_s

    def compute_stop_latency_s(self) -> float:
        """Return the maximum time from the host's stop until the board has received it, s.

        A zero where a frame should begin means stop. At most one frame, of maximum length, is on
        the line before it. In full duplex this is a frame of the host, and the zero follows its
        end. On a shared bus it may be a frame of a board, and the zero is sent at the beginning of
        the slot after it.
        """
        return self.compute_duration_s(MAX_FRAME_BYTES + 1)

    def compute_load(
        self, telemetry_hz: float, capture_hz: float = 0.0, axis_count: int = 0
    ) -> float:
        """Return the fraction of the board-to-host capacity that telemetry and a capture use.

        On a shared bus this includes the telemetry of both boards, a capture by one board, and the
        polls. ``axis_count`` is the number of captured axes.
        """
        inputs_bytes = (
            _count_wire_bytes(OperatorInputs) + _INPUT_READINGS_BYTES
        ) / _TELEMETRY_FRAMES_PER_INPUTS
        bytes_per_telemetry = (
            _count_wire_bytes(Telemetry) + AXES_PER_BOARD * AXIS_BYTES + inputs_bytes
        )
        capture_bytes_per_s = frames_hz = 0.0
        if axis_count:
            samples_per_frame = (MAX_FRAME_BYTES - _count_wire_bytes(CaptureSamples)) // (
                _CAPTURED_VALUE_BYTES * axis_count
            )
            frames_hz = capture_hz / samples_per_frame
            capture_bytes_per_s = frames_hz * (
                _count_wire_bytes(CaptureSamples)
                + samples_per_frame * _CAPTURED_VALUE_BYTES * axis_count
            )
        if self.half_duplex:
            poll_and_slot_bytes = _OVERHEAD_BYTES + _SLOT_BYTES
            bytes_per_telemetry = poll_and_slot_bytes + _BOARDS_ON_BUS * (
                bytes_per_telemetry + _SLOT_BYTES
            )
            capture_bytes_per_s += frames_hz * (poll_and_slot_bytes + _SLOT_BYTES)
        return (telemetry_hz * bytes_per_telemetry + capture_bytes_per_s) / self.bytes_per_s


def compute_rates(line: LineCapacity, tick_hz: int = DEFAULT_TICK_HZ) -> BoardRates:
    """Return the maximum rates that a board offers on a line, given the rate of its control ticks.

    Trajectory rows are streamed at the telemetry rate, or at half of it on a shared bus, and a
    segment holds two rows.
    """

    def is_possible(telemetry_hz: float, capture_hz: float = 0.0, axis_count: int = 0) -> bool:
        return line.compute_load(telemetry_hz, capture_hz, axis_count) <= _MAX_LOAD

    telemetry_hz = next(
        rates.telemetry_hz for rates in _CANDIDATE_RATES if is_possible(rates.telemetry_hz)
    )
    capture_rates = next(
        rates
        for rates in _CANDIDATE_RATES
        if is_possible(rates.telemetry_while_capturing_hz, rates.capture_one_axis_hz, 1)
        and is_possible(rates.telemetry_while_capturing_hz, rates.capture_three_axes_hz, 3)
    )
    line_rates = capture_rates._replace(telemetry_hz=telemetry_hz)
    chip_rates = (rate_hz * tick_hz // _CHIP_TICK_HZ for rate_hz in _CHIP_RATES)
    rates = _RateSet(*map(min, line_rates, chip_rates))
    segments_hz = ceil(rates.telemetry_hz / (ROWS_PER_SEGMENT * (2 if line.half_duplex else 1)))
    return BoardRates(*rates, segments_hz, tick_hz)


def _count_wire_bytes(message_class: type[WireMessage]) -> int:
    """Return the wire size of a board's message, bytes, without its variable-length field."""
    return _LEADING_ZERO_BYTES + _OVERHEAD_BYTES + message_class.LAYOUT.size
