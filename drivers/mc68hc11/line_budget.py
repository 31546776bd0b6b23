"""What a serial line can carry: the rates that a board announces, and the time a stop takes.

All of it is counted in bytes of ten bits. On a shared bus every frame is followed by a slot in
which the host alone may begin to speak, so that a stop never waits for more than one frame.

A telemetry frame has 31 bytes, and every fourth is followed by 14 bytes of inputs. A capture frame
holds up to 11 samples of one axis, or 3 of three.
"""

from dataclasses import dataclass
from math import ceil

from rotemina.drivers.mc68hc11.board_messages import AXIS_BYTES, Captured, Inputs, Rates, Telemetry
from rotemina.drivers.mc68hc11.framing import MAX_FRAME
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import AXES

BITS_A_BYTE = 10  # start, eight, stop
BAUDS = (125_000, 9_600)
_OVERHEAD = 7  # address, number, type, check, stuffing, the zero behind
_ZERO_BEFORE = 1  # of what a board says
_READINGS = 5  # bytes: a joystick's three potentiometers
_INPUTS_EVERY = 4  # telemetry frames
_SAMPLE = 2  # bytes of one axis
_SLOT = 3  # bytes of silence after a frame on a shared bus
_BOARDS = 2  # on a shared bus
_MOST = 0.95  # of a line that is used
TICK_HZ = 2000  # of the chip at E = 4 MHz
# Hz at a tick of 1 kHz, E = 2 MHz: what the chip keeps up, see ``firmware/budget.py``.
_CHIP_HZ, _CHIP = 1000, (100, 25, 1000, 250)
ROWS = 2  # of a trajectory in one segment of a stream
_WISHED = (  # Hz: telemetry alone and while capturing, capture of one axis and of three
    (200, 50, 2000, 1000),
    (100, 25, 1000, 500),
    (50, 10, 500, 200),
    (20, 10, 200, 100),
    (10, 5, 100, 50),
    (5, 2, 100, 25),
    (4, 2, 50, 25),
)


@dataclass(frozen=True, slots=True)
class Line:
    """A serial line: its speed, and whether both directions, and both boards, share it."""

    baud: int
    half_duplex: bool = False

    @property
    def bytes_per_s(self) -> float:
        """What goes over it in one direction."""
        return self.baud / BITS_A_BYTE

    def seconds(self, count: int) -> float:
        """Return how long some bytes take."""
        return count / self.bytes_per_s

    def stop_s(self) -> float:
        """Return the time from the call to the board's stop, at most.

        One frame is under way. On two lines the board has heard its end, so that a single zero is
        enough; on a shared bus a board may be speaking, which hears the slot's first zero.
        """
        return self.seconds(MAX_FRAME + 1)

    def load(self, telemetry_hz: float, capture_hz: float = 0.0, axes: int = 0) -> float:
        """Return the share of the line, from board to host, that telemetry and a capture take.

        On a shared bus: of both boards' telemetry, one board's capture, and the polls.
        """
        inputs = (_wire(Inputs) + _READINGS) / _INPUTS_EVERY
        telemetry = _wire(Telemetry) + AXES * AXIS_BYTES + inputs
        captured = frames_hz = 0.0
        if axes:
            samples = (MAX_FRAME - _wire(Captured)) // (_SAMPLE * axes)
            frames_hz = capture_hz / samples
            captured = frames_hz * (_wire(Captured) + samples * _SAMPLE * axes)
        if self.half_duplex:
            poll = _OVERHEAD + _SLOT
            telemetry = poll + _BOARDS * (telemetry + _SLOT)
            captured += frames_hz * (poll + _SLOT)
        return (telemetry_hz * telemetry + captured) / self.bytes_per_s


def rates(line: Line, tick_hz: int = TICK_HZ) -> Rates:
    """Return the greatest rates that a board announces on a line, at its control ticks a second.

    Segments: two rows each, at the rate of telemetry, or half of it on a shared bus.
    """

    def fits(telemetry_hz: float, capture_hz: float = 0.0, axes: int = 0) -> bool:
        return line.load(telemetry_hz, capture_hz, axes) <= _MOST

    telemetry = next(one[0] for one in _WISHED if fits(one[0]))
    slower, one, three = next(
        own[1:] for own in _WISHED if fits(own[1], own[2], 1) and fits(own[1], own[3], 3)
    )
    chip = (rate * tick_hz // _CHIP_HZ for rate in _CHIP)
    telemetry, slower, one, three = map(min, (telemetry, slower, one, three), chip)
    segments = ceil(telemetry / (ROWS * (2 if line.half_duplex else 1)))
    return Rates(telemetry, slower, one, three, segments, tick_hz)


def _wire(message: type[Message]) -> int:
    """Return the bytes on the wire of what a board says, without its tail."""
    return _ZERO_BEFORE + _OVERHEAD + message.LAYOUT.size
