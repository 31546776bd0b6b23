"""Handshake with the boards: identifies and checks them, and starts their telemetry."""

import logging
from collections.abc import Callable, Sequence
from functools import partial
from math import ceil
from typing import NamedTuple, Self

from rotemina.drivers.contract import (
    Clock,
    DriverError,
    DriverTimeoutError,
    Permit,
    ProtocolError,
)
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.dialogue import BoardRequest, RequestUrgency
from rotemina.drivers.mc68hc11.line_budget import BAUD_RATES, ROWS_PER_SEGMENT, LineCapacity
from rotemina.drivers.mc68hc11.parameter_check import ParameterCheck
from rotemina.drivers.mc68hc11.protocol import (
    PROTOCOL_VERSION,
    AskKind,
    AxisDescription,
    BoardAbility,
    BoardFault,
    BoardIdentity,
    BoardKind,
    BoardRates,
    BoardState,
    ClearFault,
    DescribeAxis,
    IdentifyBoard,
    PollBoard,
    RequestRates,
    SetTelemetry,
    SetWatchdog,
    StopBoard,
    Telemetry,
    WireMessage,
)
from rotemina.drivers.mc68hc11.sampling_grid import SamplingGrid
from rotemina.drivers.mc68hc11.serial_link import SerialLink
from rotemina.sim.messages import (
    format_rounded,
    join_messages,
    marked,
    message,
)
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact

_LOG = logging.getLogger(__name__)
_EXCHANGE_PAUSE_S = 5e-4
# The first trial waits for `answer_s`, and each further trial twice as long, up to this time.
_MAX_FIRST_ANSWER_S = 1.5
# While the connection is opened, a board may receive nothing for this many round trips.
_MIN_WATCHDOG_ROUND_TRIPS = 3
# On a shared bus polls alternate with requests, and each of two boards is polled separately.
_ROUND_TRIPS_PER_BUS_SAMPLE = 4
# A board that sends no sample for a longer time counts as lost.
_MAX_SAMPLE_PERIOD_S = 0.5
# Longer round trips cause a warning, because a stop takes longer.
_SLOW_ROUND_TRIP_S = 0.1
# A board that does not report its kind within this many answer times counts as a real one.
_KIND_ROUND_TRIPS = 4
# The shortest of these round trips counts, because a busy computer may delay some of them.
_ROUND_TRIP_TRIALS = 3
_REQUEST_TIMEOUT_S = 1.0
# Number of requests that the boards of a line answer one after the other.
_DESCRIPTION_REQUEST_COUNT, _PARAMETER_REQUEST_COUNT = 12, 30
_PARAMETER_TIMEOUT_S = 2.5
_REST_TIMEOUT_S = 2.0
_MOTION_STATES = BoardState.MOVING | BoardState.PLAYING | BoardState.HOMING
# Each poll gives an estimate of the board's clock.
_POLL_COUNT = 4
_TELEMETRY_RATES_HZ = (200, 100, 50, 20, 10, 5, 4)
_MAX_LINE_LOAD = 0.95
# Faults from before this connection: a stop, a silent host, or power-up.
_EARLIER_FAULTS = (BoardFault.STOPPED, BoardFault.WATCHDOG, BoardFault.RESET)


class BoardHandshake:
    """Handshake with all boards, which opens the connection.

    Parameters
    ----------
    robot : Robot
    boards : sequence of Board
        Boards that are already assigned to their links.
    baud : int
    watchdog_ms : int
        Time without a message from the host after which a board halts.
    clock : callable
        Return the host time, s.
    pause : callable
        Wait for some seconds.
    exchange : callable
        Receive and send pending frames on all links.
    permit : Permit
        Permit for clearing faults from before this connection.
    """

    def __init__(
        self,
        robot: Robot,
        boards: Sequence[Board],
        baud: int,
        watchdog_ms: int,
        *,
        clock: Clock,
        pause: Callable[[float], None],
        exchange: Callable[[], None],
        permit: Permit,
    ) -> None:
        self._robot = robot
        self._boards = tuple(boards)
        self._baud = baud
        self._watchdog_ms = watchdog_ms
        self._clock = clock
        self._pause = pause
        self._exchange = exchange
        self._permit = permit
        self.period_ms = 0
        self.samples_per_setpoint = 1

    def run(self) -> ParameterCheck:
        """Identify and check the boards, and start their telemetry.

        Returns
        -------
        ParameterCheck
            The comparison of the boards' parameters with the robot file.

        Raises
        ------
        DriverError
            If the boards do not answer, or do not belong to the robot. The message says what to do.
        """
        for board in self._boards:
            self._identify(board)
        for board in self._boards:
            self._check_identity(board)
            board.link.half_duplex = board.has_ability(BoardAbility.HALF_DUPLEX)
            board.clock.follows_drift = not board.link.half_duplex
        for board in self._boards:
            self._measure_round_trip(board)
        self._ask_kinds()
        self._check_axes()
        parameter_check = ParameterCheck(self._robot, self._boards)
        parameter_check.compare_fingerprints()
        self._wait_until(
            self._is_idle,
            _PARAMETER_TIMEOUT_S,
            marked("engine", "to report all parameters"),
            request_count=_PARAMETER_REQUEST_COUNT * len(self._boards),
        )
        self._poll_clocks()
        self._bring_to_rest()
        self._begin_telemetry()
        for board in self._boards:
            board.detects_reset = True
        return parameter_check

    def _identify(self, board: Board) -> None:
        link, dialogue = board.link, board.dialogue
        counts_before = _ReceivedCounts.read(link)
        refusals: list[int | None] = []
        wait_s = link.answer_s
        while board.identity is None:
            if not dialogue.has_requests:
                if wait_s > max(_MAX_FIRST_ANSWER_S, 2.0 * link.answer_s):
                    raise _explain_silence(
                        board, self._baud, _ReceivedCounts.read(link) - counts_before, any(refusals)
                    )
                # The frame is never repeated. If the board has seen its number before, it would
                # repeat its answer to an earlier frame with that number.
                dialogue.answer_s = wait_s
                dialogue.ask(
                    BoardRequest(
                        message=IdentifyBoard(PROTOCOL_VERSION),
                        answer_type=BoardIdentity,
                        on_answer=partial(_note_identity, board),
                        on_refusal=refusals.append,
                        expires_s=self._clock() + wait_s,
                    )
                )
                wait_s *= 2.0
            self._exchange()
            self._pause(_EXCHANGE_PAUSE_S)
        dialogue.answer_s = link.answer_s

    def _measure_round_trip(self, board: Board) -> None:
        """Measure the round trip to a board, and extend the time for its answers accordingly."""
        round_trips_s: list[float] = []
        # The request is not repeated within this time, so the answer belongs to it.
        board.dialogue.answer_s = _MAX_FIRST_ANSWER_S
        while not round_trips_s or (
            min(round_trips_s) > board.link.answer_s and len(round_trips_s) < _ROUND_TRIP_TRIALS
        ):
            start_s = self._clock()
            board.dialogue.ask(
                BoardRequest(
                    message=RequestRates(),
                    answer_type=BoardRates,
                    on_answer=partial(_note_rates, board),
                )
            )
            self._wait_until(
                self._is_idle, 2.0 * _MAX_FIRST_ANSWER_S, marked("engine", "to report its rates")
            )
            round_trips_s.append(self._clock() - start_s)
        board.dialogue.answer_s = board.link.answer_s
        board.round_trip_s = min(round_trips_s)
        self._require_short_round_trip(board)
        if board.round_trip_s > _SLOW_ROUND_TRIP_S:
            round_trip = format_exact(board.round_trip_s, "s")
            _LOG.warning("%s answers after %s: a stop takes half as long", board.where, round_trip)
        board.link.extend_answer_time(board.round_trip_s)

    def _require_short_round_trip(self, board: Board) -> None:
        trip_s = board.round_trip_s
        sample_s = _ROUND_TRIPS_PER_BUS_SAMPLE * trip_s
        if board.link.half_duplex and sample_s > _MAX_SAMPLE_PERIOD_S:
            raise DriverError(
                "{where} answers, but takes {trip}: on a shared bus this allows a sample every"
                " {sample} at best, but one every {limit} is needed. Use a faster connection, "
                "or a separate line for each board",
                where=board.where,
                trip=format_exact(trip_s, "s"),
                sample=format_exact(sample_s, "s"),
                limit=format_exact(_MAX_SAMPLE_PERIOD_S, "s"),
            )
        watchdog_s, min_watchdog_s = 1e-3 * self._watchdog_ms, _MIN_WATCHDOG_ROUND_TRIPS * trip_s
        if watchdog_s < min_watchdog_s:
            raise DriverError(
                "{where} answers, but takes {trip}: with watchdog_s = {watch} it would halt "
                "between two messages. Use a faster connection, or set watchdog_s to {least} "
                "or more; after a lost connection the axes keep moving for that time",
                where=board.where,
                trip=format_exact(trip_s, "s"),
                watch=format_rounded(watchdog_s),
                least=format_rounded(min_watchdog_s, 2),
            )

    def _check_identity(self, board: Board) -> None:
        identity = board.identity
        assert identity is not None, "the board has been identified"
        if identity.version != PROTOCOL_VERSION:
            outdated_part = (
                marked("engine", "board's program")
                if identity.version < PROTOCOL_VERSION
                else marked("engine", "program on this computer")
            )
            raise ProtocolError(
                "{where} uses version {version} of the protocol, this program {own}; "
                "update the {older}",
                where=board.where,
                version=identity.version,
                own=PROTOCOL_VERSION,
                older=outdated_part,
            )
        if identity.axes != len(board.axes):
            names = ", ".join(axis.name for axis in board.axes)
            raise DriverError(
                "{where} has {axes} axes, but robot {name} has {count} there ({names}); "
                "choose the robot file of this machine",
                where=board.where,
                axes=identity.axes,
                name=repr(self._robot.name),
                count=len(board.axes),
                names=names,
            )

    def _ask_kinds(self) -> None:
        """Ask each board for its kind. A board counts as real unless it says that it is virtual."""
        for board in self._boards:
            wait_s = _KIND_ROUND_TRIPS * len(self._boards) * board.link.answer_s
            board.dialogue.ask(
                BoardRequest(
                    message=AskKind(),
                    answer_type=BoardKind,
                    on_answer=partial(_note_kind, board),
                    expires_s=self._clock() + wait_s,
                )
            )
        self._wait_until(
            self._is_idle,
            _REQUEST_TIMEOUT_S,
            marked("engine", "to report its kind"),
            request_count=2 * _KIND_ROUND_TRIPS * len(self._boards),
        )

    def _check_axes(self) -> None:
        mismatches: list[str] = []
        for board in self._boards:
            board.dialogue.ask(BoardRequest(message=SetWatchdog(self._watchdog_ms)))
            for axis in board.axes:
                board.dialogue.ask(
                    BoardRequest(
                        message=DescribeAxis(axis.number),
                        answer_type=AxisDescription,
                        is_answer=partial(_is_description_of, axis.number),
                        on_answer=partial(self._check_description, board, mismatches),
                    )
                )
        self._wait_until(
            self._is_idle,
            _REQUEST_TIMEOUT_S,
            marked("engine", "to describe its axes"),
            request_count=_DESCRIPTION_REQUEST_COUNT,
        )
        if mismatches:
            raise DriverError(
                "{wrong}; choose the robot file of this machine",
                wrong=join_messages(mismatches, "; "),
            )

    def _check_description(
        self, board: Board, mismatches: list[str], description: WireMessage, _now_s: float
    ) -> None:
        assert isinstance(description, AxisDescription), "the request accepts only this type"
        axis = board.axes[description.axis]
        expected = axis.describe(self._robot)
        for field in ("kind", "role", "unit"):
            if getattr(description, field) != getattr(expected, field):
                mismatches.append(
                    message(
                        "engine",
                        "{where}: {what} of axis {axis} is {told}, but {wanted} in the robot file",
                    ).fill(
                        where=board.where,
                        what=field,
                        axis=axis.name,
                        told=str(getattr(description, field)),
                        wanted=str(getattr(expected, field)),
                    )
                )
        step = description.mantissa * 10.0**description.exponent
        if abs(step - axis.step_size) > 1e-6 * axis.step_size:
            mismatches.append(
                message(
                    "engine",
                    "{where}: the step of axis {axis} is {step}, but {wanted} in the robot file",
                ).fill(where=board.where, axis=axis.name, step=step, wanted=axis.step_size)
            )

    def _poll_clocks(self) -> None:
        for _ in range(_POLL_COUNT):
            self._poll_all()
            self._wait_until(
                self._is_idle, _REQUEST_TIMEOUT_S, marked("engine", "to report its position")
            )
        self._wait_until(
            lambda: all(board.latest is not None for board in self._boards),
            _REQUEST_TIMEOUT_S,
            marked("engine", "to report its position"),
            self._poll_all,
        )

    def _bring_to_rest(self) -> None:
        """Stop axes that still move, and clear faults from before this connection.

        If the gate is stopped, now or in the meantime, the boards keep their faults.
        """
        for board in self._boards:
            # A board with a fault is not stopped: it comes to rest by itself. After power-up it may
            # still ramp its piezos.
            if board.telemetry_fault is BoardFault.NONE and board.state & _MOTION_STATES:
                board.dialogue.ask(BoardRequest(message=StopBoard(), urgency=RequestUrgency.STOP))
        self._wait_until(
            lambda: not any(board.state & BoardState.MOVING for board in self._boards),
            _REST_TIMEOUT_S,
            marked("engine", "to come to rest"),
            self._poll_all,
        )
        for board in self._boards:
            if board.telemetry_fault in _EARLIER_FAULTS:
                board.dialogue.ask(BoardRequest(message=ClearFault(), permit=self._permit))
        self._wait_until(self._is_idle, _REQUEST_TIMEOUT_S, marked("engine", "to clear its fault"))

    def _begin_telemetry(self) -> None:
        self.period_ms, self.samples_per_setpoint = self._choose_periods()
        period_us = 1000 * self.period_ms
        begin_s = self._clock() + 2.0 * max(board.link.answer_s for board in self._boards)
        for board in self._boards:
            begin_us = board.clock.to_board_time_us(begin_s)
            board.grid = SamplingGrid(period_us, begin_us)
            board.samples.clear()
            board.dialogue.ask(
                BoardRequest(message=SetTelemetry(self.period_ms, begin_us % (1 << 32)))
            )
        self._wait_until(
            lambda: all(board.samples for board in self._boards),
            _REQUEST_TIMEOUT_S + 4e-3 * self.period_ms,
            marked("engine", "to send telemetry"),
        )

    def _choose_periods(self) -> tuple[int, int]:
        """Return the period of telemetry, ms, and the number of samples per set-point.

        On a shared bus segments are sent between the samples, so both rates are lower.
        """
        all_rates = [board.rates for board in self._boards if board.rates is not None]
        max_telemetry_hz = min(rates.telemetry for rates in all_rates)
        segments_hz = min(rates.segments for rates in all_rates)
        if max_telemetry_hz <= 0 or segments_hz <= 0:
            raise ProtocolError(
                "{where} reports no rate of telemetry or segments", where=self._boards[0].where
            )
        line = LineCapacity(self._baud, self._boards[0].link.half_duplex)
        suitable_rates_hz = (
            hz
            for hz in _TELEMETRY_RATES_HZ
            if hz <= max_telemetry_hz and line.compute_load(hz) <= _MAX_LINE_LOAD
        )
        telemetry_hz = next(suitable_rates_hz, max_telemetry_hz)
        period_ms = 1000 // telemetry_hz
        for board, rates in zip(self._boards, all_rates, strict=True):
            if rates.tick <= 0 or period_ms * rates.tick % 1000:
                raise ProtocolError(
                    "{where} reports {tick} ticks per second, but the {period_ms} ms between "
                    "two samples must be a whole number of ticks",
                    where=board.where,
                    tick=rates.tick,
                    period_ms=period_ms,
                )
        return period_ms, ceil(telemetry_hz / (ROWS_PER_SEGMENT * segments_hz))

    def _poll_all(self) -> None:
        for board in self._boards:
            if not board.dialogue.has_requests:
                # The poll is not repeated, because the board may answer with another message.
                expires_s = self._clock() + board.link.answer_s
                board.dialogue.ask(
                    BoardRequest(message=PollBoard(), answer_type=Telemetry, expires_s=expires_s)
                )

    def _is_idle(self) -> bool:
        return not any(board.has_pending_requests() for board in self._boards)

    def _wait_until(
        self,
        is_done: Callable[[], bool],
        limit_s: float,
        task: str,
        run_meanwhile: Callable[[], None] = lambda: None,
        request_count: int = _ROUND_TRIP_TRIALS,
    ) -> None:
        """Exchange frames until a condition holds.

        The time limit is extended by the time for the answers to all requests. A time-out error
        says which ``task`` was not completed.
        """
        limit_s += request_count * max(board.link.answer_s for board in self._boards)
        end_s = self._clock() + limit_s
        while not is_done():
            if self._clock() > end_s:
                busy_boards = [
                    board.where for board in self._boards if board.has_pending_requests()
                ]
                names = ", ".join(busy_boards) or self._boards[0].where
                raise DriverTimeoutError(
                    "{who} took longer than {limit_s} s {what}; check cable and supply",
                    who=names,
                    limit_s=format_rounded(limit_s, 2),
                    what=task,
                )
            run_meanwhile()
            self._exchange()
            self._pause(_EXCHANGE_PAUSE_S)


def _note_identity(board: Board, identity: WireMessage, _now_s: float) -> None:
    assert isinstance(identity, BoardIdentity), "the request accepts only this type"
    board.identity = identity


def _note_kind(board: Board, answer: WireMessage, _now_s: float) -> None:
    assert isinstance(answer, BoardKind), "the request accepts only this type"
    board.kind = answer.kind


def _note_rates(board: Board, rates: WireMessage, _now_s: float) -> None:
    assert isinstance(rates, BoardRates), "the request accepts only this type"
    board.rates = rates


def _is_description_of(axis: int, answer: WireMessage) -> bool:
    return isinstance(answer, AxisDescription) and answer.axis == axis


class _ReceivedCounts(NamedTuple):
    received_bytes: int
    echo_count: int
    unknown_message_count: int
    unexpected_addresses: frozenset[int]

    @classmethod
    def read(cls, link: SerialLink) -> Self:
        """Return the current counts of a link."""
        return cls(
            link.received_bytes,
            link.echo_count,
            link.unknown_message_count,
            frozenset(link.unexpected_addresses),
        )

    def __sub__(self, earlier: Self) -> Self:
        """Return the counts since ``earlier``. Unexpected addresses are not subtracted."""
        return self._replace(
            received_bytes=self.received_bytes - earlier.received_bytes,
            echo_count=self.echo_count - earlier.echo_count,
            unknown_message_count=self.unknown_message_count - earlier.unknown_message_count,
        )


def _explain_silence(
    board: Board, baud: int, counts: _ReceivedCounts, is_refused: bool
) -> DriverError:
    other_rates = ", ".join(f"{rate}" for rate in BAUD_RATES if rate != baud)
    if is_refused or counts.unknown_message_count:
        return ProtocolError(
            "{where} answers, but not in version {own} of the protocol, which this program "
            "uses; update the board's program",
            where=board.where,
            own=PROTOCOL_VERSION,
        )
    if counts.unexpected_addresses:
        return ProtocolError(
            "{where}: board {other} answers there instead; swap the cables, or the settings "
            "port and second_port",
            where=board.where,
            other=", ".join(map(str, sorted(counts.unexpected_addresses))),
        )
    if counts.echo_count:
        return DriverTimeoutError(
            "{where}: this program receives its own frames ({count}), and no board answers; "
            "check the power of the board, and whether transmit and receive lines are "
            "connected to each other",
            where=board.where,
            count=counts.echo_count,
        )
    if counts.received_bytes:
        return ProtocolError(
            "{where}: {count} bytes arrive at {baud} baud, but no valid frame of a board; "
            "check the baud rate (others: {others}), and whether an MC68HC11 board is "
            "connected to this port",
            where=board.where,
            count=counts.received_bytes,
            baud=baud,
            others=other_rates,
        )
    return DriverTimeoutError(
        "{where}: no answer at {baud} baud; check the power of the board, its cable (at "
        "this port, not the other board's), and the baud rate (others: {others})",
        where=board.where,
        baud=baud,
        others=other_rates,
    )
