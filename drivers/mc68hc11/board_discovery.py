"""Getting to know the boards: who is there, what they are, and their samples in step."""

from collections.abc import Callable, Sequence
from functools import partial
from math import ceil

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError, DriverTimeoutError, ProtocolError
from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.board_messages import AxisDescription, Identity, Rates, Telemetry
from rotemina.drivers.mc68hc11.dialogue import Request, Urgency
from rotemina.drivers.mc68hc11.host_messages import (
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
from rotemina.sim.messages import joined, marked, message
from rotemina.sim.robot.model import Robot

_PAUSE_S = 5e-4
_IDENTIFY_S = 0.6
_ASK_S = 1.0
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
        self._ask()
        trust = Trust(self._robot, self._boards)
        trust.compare()
        self._wait(self._quiet, _READ_S, marked("engine", "to report all parameters"))
        self._look()
        self._settle()
        self._begin_telemetry()
        for board in self._boards:
            board.wary = True
        return trust

    def _identify(self, board: Board) -> None:
        rejected = board.link.rejected
        end_s = self._clock() + _IDENTIFY_S + 2.0 * board.link.answer_s
        while board.identity is None:
            now_s = self._clock()
            if now_s > end_s:
                raise _nobody(board, self._baud, garbage=board.link.rejected > rejected)
            if not board.dialogue.busy:
                # Never repeated: a board that counts the same number would repeat another answer.
                board.dialogue.ask(
                    Request(
                        message=Identify(VERSION),
                        answer=Identity,
                        answered=partial(_identified, board),
                        expires_s=now_s + board.link.answer_s,
                    )
                )
            self._exchange()
            self._pause(_PAUSE_S)

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

    def _ask(self) -> None:
        wrong: list[str] = []
        for board in self._boards:
            board.dialogue.ask(Request(message=Watch(self._watch_ms)))
            board.dialogue.ask(
                Request(message=AskRates(), answer=Rates, answered=partial(_rated, board))
            )
            for axis in board.axes:
                board.dialogue.ask(
                    Request(
                        message=DescribeAxis(axis.number),
                        answer=AxisDescription,
                        matches=partial(_describes, axis.number),
                        answered=partial(self._described, board, wrong),
                    )
                )
        self._wait(self._quiet, _ASK_S, marked("engine", "to describe its axes"))
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
    ) -> None:
        end_s = self._clock() + limit_s
        while not done():
            if self._clock() > end_s:
                late = [board.where for board in self._boards if board.busy_line()]
                who = ", ".join(late) or self._boards[0].where
                raise DriverTimeoutError(
                    message(
                        "engine",
                        "{who} took longer than {limit_s} s {what}; check cable and supply",
                    ).fill(who=who, limit_s=limit_s, what=what)
                )
            meanwhile()
            self._exchange()
            self._pause(_PAUSE_S)


def _identified(board: Board, told: Message, _now_s: float) -> None:
    assert isinstance(told, Identity), "it was matched"
    board.identity = told


def _rated(board: Board, told: Message, _now_s: float) -> None:
    assert isinstance(told, Rates), "it was matched"
    board.rates = told


def _describes(axis: int, told: Message) -> bool:
    return isinstance(told, AxisDescription) and told.axis == axis


def _nobody(board: Board, baud: int, *, garbage: bool) -> DriverError:
    """Return what to say about a board that did not answer."""
    others = ", ".join(f"{one}" for one in BAUDS if one != baud)
    if garbage:
        return ProtocolError(
            message(
                "engine",
                "{where}: at {baud} baud no valid frame of a board arrives; check the baud "
                "rate (others: {others}), and whether an MC68HC11 board is connected to "
                "this port",
            ).fill(where=board.where, baud=baud, others=others)
        )
    return DriverTimeoutError(
        message(
            "engine",
            "{where}: no answer at {baud} baud; check the power of the board, its cable (at "
            "this port, not the other board's), and the baud rate (others: {others})",
        ).fill(where=board.where, baud=baud, others=others)
    )
