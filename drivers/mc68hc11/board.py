"""One board as its host knows it: who it is, what it said last, and what it has yet to be told."""

from collections import deque
from dataclasses import dataclass

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.board_clock import BoardClock
from rotemina.drivers.mc68hc11.board_messages import Identity, Inputs, Rates, Telemetry
from rotemina.drivers.mc68hc11.dialogue import Dialogue, Urgency
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.pending_orders import Orders
from rotemina.drivers.mc68hc11.protocol_codes import Ability, Fault, State
from rotemina.drivers.mc68hc11.sampling_grid import Grid
from rotemina.drivers.mc68hc11.serial_link import Link
from rotemina.drivers.reading_check import REPORTS_OF_A_NEW_POSITION, ReadingCheck
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import marked, message

_KEPT = 4096  # samples that nobody has asked for yet
_TELEMETRY_BYTES = 31
# Commands change with set-points, of which each may hold for so long, s.
_MAX_HOLD_S = 0.1
_FAULTS = frozenset(Fault)
_LOW = marked("engine", "low")  # ends of an axis that has switches
_HIGH = marked("engine", "high")
_WORDS = {
    Fault.STOPPED: marked(
        "engine", "stopped by a stop on the line that this program did not send; check the line"
    ),
    Fault.WATCHDOG: marked("engine", "the host was silent for too long; the board halted"),
    Fault.LIMIT_SWITCH: marked("engine", "a limit switch was reached"),
    Fault.SOFT_LIMIT: marked("engine", "an axis reached an end of its range"),
    Fault.SENSOR: marked("engine", "a position sensor failed"),
    Fault.BROWN_OUT: marked("engine", "the supply voltage dropped; home it again"),
    Fault.RESET: marked("engine", "the board was reset; home it again"),
    Fault.LATE_SETPOINT: marked("engine", "a set-point came too late; the trajectory ended there"),
    Fault.PROFILE: marked("engine", "the profile could not be run"),
    Fault.TOO_FAST: marked(
        "engine", "a set-point was farther away than the axis can move in that time; it was refused"
    ),
}


@dataclass(frozen=True, slots=True)
class BoardSample:
    """What a board told of one sample: readings and commands of its axes, steps.

    ``number`` counts the sampling instants that all boards share; ``sound``: no fault then.
    """

    number: int
    time_us: int
    readings: tuple[int, ...]
    commands: tuple[int, ...]
    sound: bool


class Board:
    """A board at the end of a link.

    Parameters
    ----------
    address : int
    axes : tuple of BoardAxis
        That it should have.
    """

    def __init__(self, address: int, axes: tuple[BoardAxis, ...]) -> None:
        self.address = address
        self.axes = axes
        self.clock = BoardClock()
        self.grid: Grid | None = None
        self.identity: Identity | None = None
        self.rates: Rates | None = None
        self.kind = b""  # as it said when it was opened
        self.round_trip_s = 0.0  # as it was measured when the board was opened
        self.telemetry_ms = 0  # the period that it has acknowledged
        self.latest: Telemetry | None = None
        self.latest_us = 0
        self.state = State(0)  # what it said last that it does
        self.telemetry_fault = Fault.NONE  # that it told last, whoever caused it
        self._told = DeviceState.IDLE  # by that state
        self.telemetry_s = 0.0  # host time of the latest
        self.inputs: Inputs | None = None
        self.samples: deque[BoardSample] = deque(maxlen=_KEPT)
        self.rest_number = -1  # the first sample after it came to rest
        self.reset = False
        self.wary = False  # whether a reset counts as one: not while it is being opened
        self.orders = Orders(address, self.clock, lambda: self.latest)
        #: What commands its telemetry may tell; None while it is being opened.
        self.reports: ReadingCheck | None = None
        self._link: Link | None = None

    @property
    def link(self) -> Link:
        """The line that it is on."""
        assert self._link is not None, "a board is put on a line before it is spoken to"
        return self._link

    @link.setter
    def link(self, link: Link) -> None:
        self._link = link
        self.orders.dialogue = link.dialogues[self.address]

    @property
    def dialogue(self) -> Dialogue:
        """What is said to it, one request after the other."""
        return self.orders.dialogue

    @property
    def where(self) -> str:
        """How messages call it."""
        return message("engine", "board {address} on {url}").fill(
            address=self.address, url=self.link.url
        )

    @property
    def fault(self) -> str | None:
        """Why it halted, in words; None for a stop that was asked for."""
        fault = self.telemetry_fault
        if fault is Fault.NONE or self.orders.explains(fault):
            return None
        words = _WORDS[fault]
        if fault is Fault.LIMIT_SWITCH and (switches := self._switches()):
            words = message("engine", "limit switch reached: {switches}").fill(switches=switches)
        return message("engine", "board {address}: {words}").fill(address=self.address, words=words)

    @property
    def activity(self) -> DeviceState:
        """What it does, or will as soon as it has heard of it."""
        if (expected := self.orders.expected) is not None:
            return expected
        return self._told

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves, and nothing is about to."""
        return self.activity is DeviceState.IDLE

    @property
    def unknown(self) -> bool:
        """Whether it does not know where it stands."""
        return self.latest is None or bool(self.state & State.POSITION_UNKNOWN)

    def able(self, ability: Ability) -> bool:
        """Whether it said that it can do something."""
        return self.identity is not None and bool(self.identity.abilities & ability)

    def commanded(self) -> tuple[int, ...]:
        """Return where its axes were commanded last, steps."""
        samples = self.latest.samples() if self.latest is not None else ()
        return tuple(command for _, command in samples)

    def told_s(self) -> float:
        """Return the time within which telemetry tells what has reached the board, s."""
        return self.link.answer_s + 2e-3 * self.telemetry_ms

    def number_at(self, host_time_s: float) -> int:
        """Return the number of the latest sample at a time of the host."""
        assert self.grid is not None, "telemetry is on"
        return self.grid.latest(self.clock.time_us(host_time_s))

    def receive(self, message: Message, now_s: float) -> None:
        """Take what it said, answer or not."""
        if isinstance(message, Telemetry):
            self._sampled(message, now_s)
        elif isinstance(message, Inputs):
            self.inputs = message

    def stop(self) -> None:
        """Forget what it was to do, and tell it to stop until it says that it has."""
        self.link.end_stream(self.address)
        self.orders.stop()

    def busy_line(self) -> bool:
        """Whether there is anything to be said to it yet."""
        return self.dialogue.busy

    def keeps_quiet(self, now_s: float, silence_s: float) -> bool:
        """Whether it has not been spoken to for so long, and nothing is about to be said."""
        said_s = self.link.said_s[self.address]
        return now_s - said_s >= silence_s and not self.dialogue.has(Urgency.BACKGROUND)

    def _sampled(self, told: Telemetry, now_s: float) -> None:
        if len(told.axes) != 5 * len(self.axes):
            return  # of another machine: told apart when the board was identified
        time_us = self.clock.unwrapped(told.time_us)
        said_s = now_s - self._wire_s()
        # A fault of before, which nobody was allowed to clear, is no reset of now.
        newly = told.fault == Fault.RESET and self.telemetry_fault is not Fault.RESET
        if self.wary and (self.clock.jumped(time_us, said_s) or newly):
            self.reset = True
            return
        if self.latest is not None and time_us <= self.latest_us and self.clock.known:
            return  # said twice, or polled before the next one was taken
        if not self._is_plausible(told, time_us):
            self.link.count_discarded()
            return
        was_busy = not self.at_rest
        self.clock.observe(time_us, said_s)
        self.latest, self.latest_us, self.telemetry_s = told, time_us, now_s
        self.state, self._told = State(told.state), _activity(State(told.state))
        self.telemetry_fault = Fault(told.fault) if told.fault in _FAULTS else Fault.SENSOR
        self.orders.seen(time_us)
        number = self.grid.number(time_us) if self.grid is not None else None
        if number is not None:
            if was_busy and self.at_rest:
                self.rest_number = number
            pairs = told.samples()
            self.samples.append(
                BoardSample(
                    number,
                    time_us,
                    tuple(reading for reading, _ in pairs),
                    tuple(command for _, command in pairs),
                    told.fault == Fault.NONE,
                )
            )

    def _is_plausible(self, told: Telemetry, time_us: int) -> bool:
        """Return whether its axes can be where it says that they are commanded.

        Readings are not judged: noise, hysteresis and ringing are what they are there to show.

        Raises
        ------
        ProtocolError
            If several reports in a row put them elsewhere.
        """
        if self.reports is None:
            return True
        if State(told.state) & (State.POSITION_UNKNOWN | State.HOMING):
            self.reports.restart()
            return True
        commands = [float(command) for _, command in told.samples()]
        device_s = 1e-6 * time_us
        known = range(len(self.axes))
        if self.reports.accepts(commands, device_s - _MAX_HOLD_S, device_s, known):
            return True
        if self.reports.shows_new_position:
            raise ProtocolError(
                message(
                    "engine",
                    "{where}: {count} reports in a row put its axes where they cannot have gone "
                    "by themselves. Check the board, connect again, and home or confirm the "
                    "position",
                ).fill(where=self.where, count=REPORTS_OF_A_NEW_POSITION)
            )
        return False

    def _wire_s(self) -> float:
        """Return how long telemetry is on the line, s."""
        return self.link.seconds(_TELEMETRY_BYTES)

    def _switches(self) -> str:
        assert self.latest is not None, "it told a fault"
        told = self.latest.switches
        ends = [
            message("engine", "{name} {end}").fill(name=axis.name, end=end)
            for number, axis in enumerate(self.axes)
            for bit, end in ((2 * number, _LOW), (2 * number + 1, _HIGH))
            if told >> bit & 1
        ]
        return ", ".join(ends)


def _activity(state: State) -> DeviceState:
    if state & State.HOMING:
        return DeviceState.HOMING
    if state & State.PLAYING:
        return DeviceState.PLAYING
    return DeviceState.MOVING if state & State.MOVING else DeviceState.IDLE
