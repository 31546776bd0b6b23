"""One board as the host knows it: identity, latest telemetry, and pending orders."""

from collections import deque
from dataclasses import dataclass

from rotemina.drivers.contract import (
    NEW_POSITION_REPORT_COUNT,
    DeviceState,
    ProtocolError,
    ReadingCheck,
)
from rotemina.drivers.mc68hc11.board_clock import BoardClockEstimator
from rotemina.drivers.mc68hc11.dialogue import BoardDialogue, RequestUrgency
from rotemina.drivers.mc68hc11.pending_orders import PendingOrders
from rotemina.drivers.mc68hc11.protocol import (
    BoardAbility,
    BoardAxis,
    BoardFault,
    BoardIdentity,
    BoardRates,
    BoardState,
    OperatorInputs,
    Telemetry,
    WireMessage,
)
from rotemina.drivers.mc68hc11.sampling_grid import SamplingGrid
from rotemina.drivers.mc68hc11.serial_link import SerialLink
from rotemina.sim.messages import marked, message

# If more samples than this are not read, the oldest ones are dropped.
_MAX_UNREAD_SAMPLES = 4096
_TELEMETRY_BYTES = 31
# Commands may change in jumps, because each set-point may be held for this time.
_MAX_HOLD_S = 0.1
_KNOWN_FAULTS = frozenset(BoardFault)
_LOW_END_TEXT = marked("engine", "low")
_HIGH_END_TEXT = marked("engine", "high")
_FAULT_TEXTS = {
    BoardFault.STOPPED: marked(
        "engine",
        "stopped by a stop signal on the line that this program did not send; check the line",
    ),
    BoardFault.WATCHDOG: marked("engine", "the host was silent for too long; the board halted"),
    BoardFault.LIMIT_SWITCH: marked("engine", "a limit switch was reached"),
    BoardFault.SOFT_LIMIT: marked("engine", "an axis reached an end of its range"),
    BoardFault.SENSOR: marked("engine", "a position sensor failed"),
    BoardFault.BROWN_OUT: marked("engine", "the supply voltage dropped; home it again"),
    BoardFault.RESET: marked("engine", "the board was reset; home it again"),
    BoardFault.LATE_SETPOINT: marked(
        "engine", "a set-point came too late; the trajectory ended there"
    ),
    BoardFault.PROFILE: marked("engine", "the profile could not be run"),
    BoardFault.TOO_FAST: marked(
        "engine",
        "a set-point was too far away for the axis to reach it in time; the set-point was refused",
    ),
}


@dataclass(frozen=True, slots=True)
class BoardSample:
    """Sample of one board: readings and commands of its axes, steps.

    ``number`` is the number of the sampling instant, which is the same for all boards.
    ``fault_free`` says whether the board had no fault.
    """

    instant_number: int
    time_us: int
    readings: tuple[int, ...]
    commands: tuple[int, ...]
    fault_free: bool


class Board:
    """Board at the end of a serial link.

    Parameters
    ----------
    address : int
    axes : tuple of BoardAxis
        Axes that the board should have, according to the robot file.
    """

    def __init__(self, address: int, axes: tuple[BoardAxis, ...]) -> None:
        self.address = address
        self.axes = axes
        self.clock = BoardClockEstimator()
        self.grid: SamplingGrid | None = None
        self.identity: BoardIdentity | None = None
        self.rates: BoardRates | None = None
        self.kind = b""
        # Measured while the connection is opened.
        self.round_trip_s = 0.0
        # The period that the board has acknowledged.
        self.telemetry_period_ms = 0
        self.latest: Telemetry | None = None
        self.latest_us = 0
        # State, fault and activity in the latest telemetry.
        self.state = BoardState(0)
        self.telemetry_fault = BoardFault.NONE
        self._reported_activity = DeviceState.IDLE
        # Host time of the latest telemetry.
        self.last_telemetry_s = 0.0
        self.inputs: OperatorInputs | None = None
        self.samples: deque[BoardSample] = deque(maxlen=_MAX_UNREAD_SAMPLES)
        # Number of the first sample after the board came to rest.
        self.rest_number = -1
        self.was_reset = False
        # False while the connection is opened, because an earlier reset does not matter.
        self.detects_reset = False
        self.orders = PendingOrders(address, self.clock, lambda: self.latest)
        #: Check of the commands that telemetry reports; None while the connection is opened.
        self.reading_check: ReadingCheck | None = None
        self._link: SerialLink | None = None

    @property
    def link(self) -> SerialLink:
        """Serial link to which the board is connected."""
        assert self._link is not None, "a board is assigned to a link before it is used"
        return self._link

    @link.setter
    def link(self, link: SerialLink) -> None:
        self._link = link
        self.orders.dialogue = link.dialogues[self.address]

    @property
    def dialogue(self) -> BoardDialogue:
        """Queue of requests to the board."""
        return self.orders.dialogue

    @property
    def where(self) -> str:
        """Address and port of the board, for messages."""
        return message("engine", "board {address} on {url}").fill(
            address=self.address, url=self.link.url
        )

    @property
    def fault_text(self) -> str | None:
        """Description of the board's fault.

        None if there is no fault, or if a stop by this host has caused it.
        """
        fault = self.telemetry_fault
        if fault is BoardFault.NONE or self.orders.is_expected_fault(fault):
            return None
        text = _FAULT_TEXTS[fault]
        if fault is BoardFault.LIMIT_SWITCH and (switches := self._name_closed_switches()):
            text = message("engine", "limit switch reached: {switches}").fill(switches=switches)
        return message("engine", "board {address}: {words}").fill(address=self.address, words=text)

    @property
    def activity(self) -> DeviceState:
        """State of motion: the one that the pending orders will cause, or else the reported one."""
        if (expected := self.orders.expected_state) is not None:
            return expected
        return self._reported_activity

    @property
    def at_rest(self) -> bool:
        """Whether no axis moves and no motion is pending."""
        return self.activity is DeviceState.IDLE

    @property
    def is_position_unknown(self) -> bool:
        """Whether the position is unknown."""
        return self.latest is None or bool(self.state & BoardState.POSITION_UNKNOWN)

    def has_ability(self, ability: BoardAbility) -> bool:
        """Return whether the board has reported an ability."""
        return self.identity is not None and bool(self.identity.abilities & ability)

    def read_commands(self) -> tuple[int, ...]:
        """Return the latest reported commands of the axes, steps; empty if there is no report."""
        samples = self.latest.unpack_samples() if self.latest is not None else ()
        return tuple(command for _, command in samples)

    def compute_report_delay_s(self) -> float:
        """Return the longest time until telemetry shows the effect of a frame, s."""
        return self.link.answer_s + 2e-3 * self.telemetry_period_ms

    def find_sample_number(self, host_time_s: float) -> int:
        """Return the number of the latest sample at a host time."""
        assert self.grid is not None, "telemetry must be on"
        return self.grid.find_latest_number(self.clock.to_board_time_us(host_time_s))

    def receive(self, message: WireMessage, now_s: float) -> None:
        """Handle a message from the board."""
        if isinstance(message, Telemetry):
            self._handle_telemetry(message, now_s)
        elif isinstance(message, OperatorInputs):
            self.inputs = message

    def stop(self) -> None:
        """Drop all orders for the board, and repeat the stop until the board acknowledges it."""
        self.link.end_stream(self.address)
        self.orders.stop()

    def has_pending_requests(self) -> bool:
        """Return whether a request is queued or waits for its answer."""
        return self.dialogue.has_requests

    def needs_keep_alive(self, now_s: float, period_s: float) -> bool:
        """Return whether the host has sent the board nothing for a period, and has nothing queued.

        Only background requests count as queued.
        """
        last_sent_s = self.link.last_sent_s[self.address]
        return now_s - last_sent_s >= period_s and not self.dialogue.has_request(
            RequestUrgency.BACKGROUND
        )

    def _handle_telemetry(self, telemetry: Telemetry, now_s: float) -> None:
        if len(telemetry.axes) != 5 * len(self.axes):
            # The board belongs to another machine. The check of its identity reports that.
            return
        time_us = self.clock.unwrap(telemetry.time_us)
        sent_s = now_s - self._compute_telemetry_duration_s()
        # A reset fault that was reported before and is not cleared yet does not mean another reset.
        is_new_reset = (
            telemetry.fault == BoardFault.RESET and self.telemetry_fault is not BoardFault.RESET
        )
        if self.detects_reset and (self.clock.has_jumped(time_us, sent_s) or is_new_reset):
            self.was_reset = True
            return
        if self.latest is not None and time_us <= self.latest_us and self.clock.is_known:
            # The board has sent this sample before, for example because it was polled twice.
            return
        if not self._is_plausible(telemetry, time_us):
            self.link.count_discarded()
            return
        was_busy = not self.at_rest
        self.clock.observe(time_us, sent_s)
        self.latest, self.latest_us, self.last_telemetry_s = telemetry, time_us, now_s
        self.state, self._reported_activity = (
            BoardState(telemetry.state),
            _find_activity(BoardState(telemetry.state)),
        )
        self.telemetry_fault = (
            BoardFault(telemetry.fault) if telemetry.fault in _KNOWN_FAULTS else BoardFault.SENSOR
        )
        self.orders.note_telemetry(time_us)
        number = self.grid.find_number(time_us) if self.grid is not None else None
        if number is not None:
            if was_busy and self.at_rest:
                self.rest_number = number
            pairs = telemetry.unpack_samples()
            self.samples.append(
                BoardSample(
                    number,
                    time_us,
                    tuple(reading for reading, _ in pairs),
                    tuple(command for _, command in pairs),
                    telemetry.fault == BoardFault.NONE,
                )
            )

    def _is_plausible(self, telemetry: Telemetry, time_us: int) -> bool:
        """Return whether the reported commands are possible.

        Readings are not checked, because noise, hysteresis and ringing may change them at any rate.

        Raises
        ------
        ProtocolError
            If several consecutive reports agree on a position that the axes cannot have reached.
        """
        if self.reading_check is None:
            return True
        if BoardState(telemetry.state) & (BoardState.POSITION_UNKNOWN | BoardState.HOMING):
            self.reading_check.restart()
            return True
        commands = [float(command) for _, command in telemetry.unpack_samples()]
        board_time_s = 1e-6 * time_us
        axis_numbers = range(len(self.axes))
        if self.reading_check.accept_report(
            commands, board_time_s - _MAX_HOLD_S, board_time_s, axis_numbers
        ):
            return True
        if self.reading_check.shows_new_position:
            raise ProtocolError(
                "{where}: {count} reports in a row show a position that its axes cannot have "
                "reached. Check the board, connect again, and home or confirm the position",
                where=self.where,
                count=NEW_POSITION_REPORT_COUNT,
            )
        return False

    def _compute_telemetry_duration_s(self) -> float:
        return self.link.compute_duration_s(_TELEMETRY_BYTES)

    def _name_closed_switches(self) -> str:
        assert self.latest is not None, "telemetry has reported a fault"
        switches = self.latest.switches
        texts = [
            message("engine", "{name} {end}").fill(name=axis.name, end=end)
            for number, axis in enumerate(self.axes)
            for bit, end in ((2 * number, _LOW_END_TEXT), (2 * number + 1, _HIGH_END_TEXT))
            if switches >> bit & 1
        ]
        return ", ".join(texts)


def _find_activity(state: BoardState) -> DeviceState:
    if state & BoardState.HOMING:
        return DeviceState.HOMING
    if state & BoardState.PLAYING:
        return DeviceState.PLAYING
    return DeviceState.MOVING if state & BoardState.MOVING else DeviceState.IDLE
