"""Getting to know the boards: who is there, what they are, and their samples in step."""

import logging
from collections.abc import Callable, Sequence
from functools import partial
from math import ceil
from typing import NamedTuple, Self

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError, DriverTimeoutError, ProtocolError
from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.board_messages import (
    AxisDescription,
    BoardKind,
    Identity,
    Rates,
    Telemetry,
)
from rotemina.drivers.mc68hc11.dialogue import Request, Urgency
from rotemina.drivers.mc68hc11.host_messages import (
    AskKind,
    AskRates,
    ClearFault,
    DescribeAxis,
    Identify,
    Poll,
    SetTelemetry,
    Stop,
    Watch,
)
from rotemina.drivers.mc68hc11.line_budget import BAUDS, ROWS, Line
from rotemina.drivers.mc68hc11.parameter_check import Trust
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import VERSION, Ability, Fault, State
from rotemina.drivers.mc68hc11.sampling_grid import Grid
from rotemina.drivers.mc68hc11.serial_link import Link
from rotemina.sim.messages import joined, marked, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.robot.model import Robot

_LOG = logging.getLogger(__name__)
_PAUSE_S = 5e-4
_PATIENCE_S = 1.5  # for the first answer of a board, at last; from `answer_s` on twice as long each
_TRIPS_A_WATCH = 3  # the longest that a board hears nothing while it is opened, in round trips
_TRIPS_A_SAMPLE = 4  # on a shared bus, where boards are polled and requests take turns with polls
_MAX_SAMPLE_S = 0.5  # between two samples: longer is a lost connection
_SLOW_S = 0.1  # from such a round trip on a warning says that a stop takes longer
_TRIPS_TO_SAY_KIND = 4  # a board that ignores the question is a real one
_TRIPS = 3  # of which the quickest counts: one may be late on a busy computer
_ASK_S = 1.0
_REQUESTS, _PARAMETERS = 12, 30  # one after the other, of the boards of a line
_READ_S = 2.5
_REST_S = 2.0
_UNDER_WAY = State.MOVING | State.PLAYING | State.HOMING
_LOOKS = 4  # at each board's clock
_RATES_HZ = (200, 100, 50, 20, 10, 5, 4)
_MOST = 0.95  # of a line
# What a board says of the time before this session: a silent host, a stop, power that came.
_OF_BEFORE = (Fault.STOPPED, Fault.WATCHDOG, Fault.RESET)


class Opening:
    """The first conversation with all boards.

    Parameters
    ----------
    robot : Robot
    boards : sequence of Board
        On their links.
    baud : int
    watch_ms : int
        After what silence of the host a board is to halt.
    clock, pause : callable
        Host time, s; let some of it pass.
    exchange : callable
        Receive and send what there is.
    """

    def __init__(
        self,
        robot: Robot,
        boards: Sequence[Board],
        baud: int,
        watch_ms: int,
        *,
        clock: Clock,
        pause: Callable[[float], None],
        exchange: Callable[[], None],
        permit: Permit,
    ) -> None:
        self._robot = robot
        self._boards = tuple(boards)
        self._baud = baud
        self._watch_ms = watch_ms
        self._clock = clock
        self._pause = pause
        self._exchange = exchange
        self._permit = permit
        self.period_ms = 0
        self.setpoint_every = 1

    def run(self) -> Trust:
        """Go through all of it; return what is thought of the boards' parameters.

        Raises
        ------
        DriverError
            If the boards do not answer, or are not those of the robot; with what to do.
        """
        for board in self._boards:
            self._identify(board)
        for board in self._boards:
            self._check(board)
            board.link.half_duplex = board.able(Ability.HALF_DUPLEX)
            board.clock.drifts = not board.link.half_duplex
        for board in self._boards:
            self._measure(board)
        self._ask_kinds()
        self._ask()
        trust = Trust(self._robot, self._boards)
        trust.compare()
        self._wait(
            self._quiet,
            _READ_S,
            marked("engine", "to report all parameters"),
            requests=_PARAMETERS * len(self._boards),
        )
        self._look()
        self._settle()
        self._begin_telemetry()
        for board in self._boards:
            board.wary = True
        return trust

    def _identify(self, board: Board) -> None:
        link, dialogue = board.link, board.dialogue
        begin = _Reply.on(link)
        refusals: list[int | None] = []
        wait_s = link.answer_s
        while board.identity is None:
            if not dialogue.busy:
                if wait_s > max(_PATIENCE_S, 2.0 * link.answer_s):
                    raise _nobody(board, self._baud, _Reply.on(link) - begin, any(refusals))
                # Never repeated: a board that counts the same number would repeat another answer.
                dialogue.answer_s = wait_s
                dialogue.ask(
                    Request(
                        message=Identify(VERSION),
                        answer=Identity,
                        answered=partial(_identified, board),
                        refused=refusals.append,
                        expires_s=self._clock() + wait_s,
                    )
                )
                wait_s *= 2.0
            self._exchange()
            self._pause(_PAUSE_S)
        dialogue.answer_s = link.answer_s

    def _measure(self, board: Board) -> None:
        """Learn how long the line takes to a board and back, and wait as long from now on."""
        trips: list[float] = []
        board.dialogue.answer_s = _PATIENCE_S  # never repeated, so that the answer is to this one
        while not trips or (min(trips) > board.link.answer_s and len(trips) < _TRIPS):
            begin_s = self._clock()
            board.dialogue.ask(
                Request(message=AskRates(), answer=Rates, answered=partial(_rated, board))
            )
            self._wait(self._quiet, 2.0 * _PATIENCE_S, marked("engine", "to tell its rates"))
            trips.append(self._clock() - begin_s)
        board.dialogue.answer_s = board.link.answer_s
        board.round_trip_s = min(trips)
        self._require_quick(board)
        if board.round_trip_s > _SLOW_S:
            trip = exact(board.round_trip_s, "s")
            _LOG.warning("%s answers after %s: a stop takes half as long", board.where, trip)
        board.link.await_answers(board.round_trip_s)

    def _require_quick(self, board: Board) -> None:
        """Refuse a line that is too slow to be worked with."""
        trip_s = board.round_trip_s
        sample_s = _TRIPS_A_SAMPLE * trip_s
        if board.link.half_duplex and sample_s > _MAX_SAMPLE_S:
            raise DriverError(
                message(
                    "engine",
                    "{where} answers, but after {trip}: on a shared bus that is a sample every "
                    "{sample} at best, and at least one every {limit} is needed. Use a faster "
                    "connection, or a line for each board",
                ).fill(
                    where=board.where,
                    trip=exact(trip_s, "s"),
                    sample=exact(sample_s, "s"),
                    limit=exact(_MAX_SAMPLE_S, "s"),
                )
            )
        watch_s, least_s = 1e-3 * self._watch_ms, _TRIPS_A_WATCH * trip_s
        if watch_s < least_s:
            raise DriverError(
                message(
                    "engine",
                    "{where} answers, but after {trip}: with watchdog_s = {watch} it would halt "
                    "between two messages. Use a faster connection, or set watchdog_s to {least} "
                    "or more: the axes go on for as long when the connection is lost",
                ).fill(
                    where=board.where,
                    trip=exact(trip_s, "s"),
                    watch=rounded(watch_s),
                    least=rounded(least_s, 2),
                )
            )

    def _check(self, board: Board) -> None:
        told = board.identity
        assert told is not None, "it was identified"
        if told.version != VERSION:
            older = (
                marked("engine", "board's program")
                if told.version < VERSION
                else marked("engine", "program on this computer")
            )
            raise ProtocolError(
                message(
                    "engine",
                    "{where} uses version {version} of the protocol, this program {own}; "
                    "update the {older}",
                ).fill(where=board.where, version=told.version, own=VERSION, older=older)
            )
        if told.axes != len(board.axes):
            names = ", ".join(axis.name for axis in board.axes)
            raise DriverError(
                message(
                    "engine",
                    "{where} has {axes} axes, but robot {name} has {count} there ({names}); "
                    "choose the robot file of this machine",
                ).fill(
                    where=board.where,
                    axes=told.axes,
                    name=repr(self._robot.name),
                    count=len(board.axes),
                    names=names,
                )
            )

    def _ask_kinds(self) -> None:
        """Ask each board whether it is a program; one that does not say so is a real board."""
        for board in self._boards:
            wait_s = _TRIPS_TO_SAY_KIND * len(self._boards) * board.link.answer_s
            board.dialogue.ask(
                Request(
                    message=AskKind(),
                    answer=BoardKind,
                    answered=partial(_told_kind, board),
                    expires_s=self._clock() + wait_s,
                )
            )
        self._wait(
            self._quiet,
            _ASK_S,
            marked("engine", "to say what it is"),
            requests=2 * _TRIPS_TO_SAY_KIND * len(self._boards),
        )

    def _ask(self) -> None:
        wrong: list[str] = []
        for board in self._boards:
            board.dialogue.ask(Request(message=Watch(self._watch_ms)))
            for axis in board.axes:
                board.dialogue.ask(
                    Request(
                        message=DescribeAxis(axis.number),
                        answer=AxisDescription,
                        matches=partial(_describes, axis.number),
                        answered=partial(self._described, board, wrong),
                    )
                )
        self._wait(
            self._quiet, _ASK_S, marked("engine", "to describe its axes"), requests=_REQUESTS
        )
        if wrong:
            raise DriverError(
                message("engine", "{wrong}; choose the robot file of this machine").fill(
                    wrong=joined(wrong, "; ")
                )
            )

    def _described(self, board: Board, wrong: list[str], told: Message, _now_s: float) -> None:
        assert isinstance(told, AxisDescription), "it was matched"
        axis = board.axes[told.axis]
        wanted = axis.described(self._robot)
        for what in ("kind", "role", "unit"):
            if getattr(told, what) != getattr(wanted, what):
                wrong.append(
                    message(
                        "engine",
                        "{where}: {what} of axis {axis} is {told}, but {wanted} in the robot file",
                    ).fill(
                        where=board.where,
                        what=what,
                        axis=axis.name,
                        told=str(getattr(told, what)),
                        wanted=str(getattr(wanted, what)),
                    )
                )
        step = told.mantissa * 10.0**told.exponent
        if abs(step - axis.step) > 1e-6 * axis.step:
            wrong.append(
                message(
                    "engine",
                    "{where}: the step of axis {axis} is {step}, but {wanted} in the robot file",
                ).fill(where=board.where, axis=axis.name, step=step, wanted=axis.step)
            )

    def _look(self) -> None:
        """Look at each board's clock and state a few times."""
        for _ in range(_LOOKS):
            self._poll_all()
            self._wait(self._quiet, _ASK_S, marked("engine", "to report its position"))
        self._wait(
            lambda: all(board.latest is not None for board in self._boards),
            _ASK_S,
            marked("engine", "to report its position"),
            self._poll_all,
        )

    def _settle(self) -> None:
        """Bring to rest what still moves, and forget what happened before this session.

        Where a stop is latched, or comes meanwhile, the boards keep their faults.
        """
        for board in self._boards:
            # One with a fault comes to rest by itself, or ramps its piezos after power came.
            if board.telemetry_fault is Fault.NONE and board.state & _UNDER_WAY:
                board.dialogue.ask(Request(message=Stop(), urgency=Urgency.STOP))
        self._wait(
            lambda: not any(board.state & State.MOVING for board in self._boards),
            _REST_S,
            marked("engine", "to come to rest"),
            self._poll_all,
        )
        for board in self._boards:
            if board.telemetry_fault in _OF_BEFORE:
                board.dialogue.ask(Request(message=ClearFault(), permit=self._permit))
        self._wait(self._quiet, _ASK_S, marked("engine", "to clear its fault"))

    def _begin_telemetry(self) -> None:
        self.period_ms, self.setpoint_every = self._periods()
        period_us = 1000 * self.period_ms
        begin_s = self._clock() + 2.0 * max(board.link.answer_s for board in self._boards)
        for board in self._boards:
            begin_us = board.clock.time_us(begin_s)
            board.grid = Grid(period_us, begin_us)
            board.samples.clear()
            board.dialogue.ask(Request(message=SetTelemetry(self.period_ms, begin_us % (1 << 32))))
        self._wait(
            lambda: all(board.samples for board in self._boards),
            _ASK_S + 4e-3 * self.period_ms,
            marked("engine", "to send telemetry"),
        )

    def _periods(self) -> tuple[int, int]:
        """Return the period of telemetry, ms, and of how many samples one has a set-point.

        On a shared bus segments go between the samples: there are fewer of both meanwhile.
        """
        told = [board.rates for board in self._boards if board.rates is not None]
        announced = min(one.telemetry for one in told)
        segments = min(one.segments for one in told)
        if announced <= 0 or segments <= 0:
            raise ProtocolError(
                message("engine", "{where} announces no rate of telemetry or segments").fill(
                    where=self._boards[0].where
                )
            )
        line = Line(self._baud, self._boards[0].link.half_duplex)
        fits = (one for one in _RATES_HZ if one <= announced and line.load(one) <= _MOST)
        rate = next(fits, announced)
        period_ms = 1000 // rate
        for board, one in zip(self._boards, told, strict=True):
            if one.tick <= 0 or period_ms * one.tick % 1000:
                raise ProtocolError(
                    message(
                        "engine",
                        "{where} announces {tick} ticks a second: none, or no whole number of "
                        "them in the {period_ms} ms between two samples",
                    ).fill(where=board.where, tick=one.tick, period_ms=period_ms)
                )
        return period_ms, ceil(rate / (ROWS * segments))

    def _poll_all(self) -> None:
        for board in self._boards:
            if not board.dialogue.busy:
                # An answer of another kind may come: then this one is not asked again.
                expires_s = self._clock() + board.link.answer_s
                board.dialogue.ask(Request(message=Poll(), answer=Telemetry, expires_s=expires_s))

    def _quiet(self) -> bool:
        return not any(board.busy_line() for board in self._boards)

    def _wait(
        self,
        done: Callable[[], bool],
        limit_s: float,
        what: str,
        meanwhile: Callable[[], None] = lambda: None,
        requests: int = _TRIPS,
    ) -> None:
        """Go on until something is done; the limit grows with the time that answers may take."""
        limit_s += requests * max(board.link.answer_s for board in self._boards)
        end_s = self._clock() + limit_s
        while not done():
            if self._clock() > end_s:
                late = [board.where for board in self._boards if board.busy_line()]
                who = ", ".join(late) or self._boards[0].where
                raise DriverTimeoutError(
                    message(
                        "engine",
                        "{who} took longer than {limit_s} s {what}; check cable and supply",
                    ).fill(who=who, limit_s=rounded(limit_s, 2), what=what)
                )
            meanwhile()
            self._exchange()
            self._pause(_PAUSE_S)


def _identified(board: Board, told: Message, _now_s: float) -> None:
    assert isinstance(told, Identity), "it was matched"
    board.identity = told


def _told_kind(board: Board, told: Message, _now_s: float) -> None:
    assert isinstance(told, BoardKind), "it was matched"
    board.kind = told.kind


def _rated(board: Board, told: Message, _now_s: float) -> None:
    assert isinstance(told, Rates), "it was matched"
    board.rates = told


def _describes(axis: int, told: Message) -> bool:
    return isinstance(told, AxisDescription) and told.axis == axis


class _Reply(NamedTuple):
    """What has come over a line, counted."""

    received_bytes: int
    echoes: int
    unknown_messages: int
    strangers: frozenset[int]

    @classmethod
    def on(cls, link: Link) -> Self:
        """Return what has come so far."""
        return cls(
            link.received_bytes, link.echoes, link.unknown_messages, frozenset(link.strangers)
        )

    def __sub__(self, earlier: Self) -> Self:
        """Return what has come since."""
        return self._replace(
            received_bytes=self.received_bytes - earlier.received_bytes,
            echoes=self.echoes - earlier.echoes,
            unknown_messages=self.unknown_messages - earlier.unknown_messages,
        )


def _nobody(board: Board, baud: int, heard: _Reply, is_refused: bool) -> DriverError:
    """Return what to say about a board that did not tell who it is."""
    others = ", ".join(f"{one}" for one in BAUDS if one != baud)
    if is_refused or heard.unknown_messages:
        return ProtocolError(
            message(
                "engine",
                "{where} answers, but not in version {own} of the protocol, which this program "
                "uses; update the board's program",
            ).fill(where=board.where, own=VERSION)
        )
    if heard.strangers:
        return ProtocolError(
            message(
                "engine",
                "{where}: board {other} answers there instead; exchange the cables, or the "
                "settings port and second_port",
            ).fill(where=board.where, other=", ".join(map(str, sorted(heard.strangers))))
        )
    if heard.echoes:
        return DriverTimeoutError(
            message(
                "engine",
                "{where}: what this program sends comes back ({count} frames), and no board "
                "answers; check the power of the board, and whether transmit and receive lines "
                "are connected to each other",
            ).fill(where=board.where, count=heard.echoes)
        )
    if heard.received_bytes:
        return ProtocolError(
            message(
                "engine",
                "{where}: {count} bytes arrive at {baud} baud, but no valid frame of a board; "
                "check the baud rate (others: {others}), and whether an MC68HC11 board is "
                "connected to this port",
            ).fill(where=board.where, count=heard.received_bytes, baud=baud, others=others)
        )
    return DriverTimeoutError(
        message(
            "engine",
            "{where}: no answer at {baud} baud; check the power of the board, its cable (at "
            "this port, not the other board's), and the baud rate (others: {others})",
        ).fill(where=board.where, baud=baud, others=others)
    )
