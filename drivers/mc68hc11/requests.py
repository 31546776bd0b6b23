"""What a host says to a board. Positions are steps of resolution, times microseconds."""

from dataclasses import dataclass
from struct import Struct

from rotemina.drivers.mc68hc11.message import Message


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
    """Be there at this time of the board; all three axes at once.

    ``index`` counts them from 0, over 255 on to 0 again; a board takes them in this order only.
    ``left`` is how many are still to come, 255 for more: at 0 the stream ends.
    """

    TYPE = 0x12
    LAYOUT = Struct(">BBIiii")

    index: int
    left: int
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
