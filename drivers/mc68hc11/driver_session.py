"""What an open connection to the boards is made of, and the round that keeps it going."""

from collections.abc import Callable, Sequence
from functools import partial
from math import inf

from rotemina.drivers.abilities import VOLTAGE_SLEW
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import ConnectionLostError, DeviceResetError
from rotemina.drivers.gate import OvertakenError, Permit
from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.board_discovery import Opening
from rotemina.drivers.mc68hc11.board_messages import Captured, Telemetry
from rotemina.drivers.mc68hc11.capturing import Capturing
from rotemina.drivers.mc68hc11.dialogue import Request, Urgency
from rotemina.drivers.mc68hc11.framing import BROADCAST, Frame, encoded
from rotemina.drivers.mc68hc11.host_messages import Poll, SetTelemetry, Watch
from rotemina.drivers.mc68hc11.parameter_check import Trust
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.sampling import Row, Sampling
from rotemina.drivers.mc68hc11.segment_player import Player
from rotemina.drivers.mc68hc11.serial_link import Link
from rotemina.drivers.mc68hc11.wire_guard import StepLimits, WireGuard
from rotemina.drivers.reading_check import ReadingBounds, ReadingCheck
from rotemina.drivers.samples import Samples
from rotemina.drivers.serial_port import OpenPort
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import Robot

LOST_S = 0.5  # without telemetry: the connection is lost
_SHORT_S = 0.1  # without telemetry: a short loss
_SHORT_PERIODS = 3.5
_KEEP_ALIVE = 4  # of the watchdog's time
_APART = 0.5  # periods between the boards' samples, from where on they are put in step again
_COMMAND_TOLERANCE = 2.0  # steps: rounding of a command and of its deviation
_APART_ON_BUS = 1.5  # where times of boards are known by their polls only


def _bounds_of(limits: StepLimits) -> ReadingBounds:
    """Return what an axis' command may do, steps; a voltage crosses its range in a second."""
    speed = max(limits.max_speed, VOLTAGE_SLEW * (limits.high - limits.low))
    return ReadingBounds(-inf, inf, speed, _COMMAND_TOLERANCE)


class Session:
    """An open connection: links, boards and what goes on between them.

    Parameters
    ----------
    robot : Robot
    axes : sequence of tuple of BoardAxis
        Of each board.
    urls : sequence of str
        One line for all boards, or one for each.
    """

    def __init__(
        self,
        robot: Robot,
        axes: Sequence[tuple[BoardAxis, ...]],
        urls: Sequence[str],
        baud: int,
        *,
        latency_s: float,
        watch_ms: int,
        clock: Clock,
        pause: Callable[[float], None],
        open_port: OpenPort,
        permit: Permit,
    ) -> None:
        self._clock = clock
        self._watch_ms = watch_ms
        self.period_ms = 1  # until the boards have told their rates
        self.player: Player | None = None
        self.playback: Player | None = None  # the latest, over or not: samples are named by it
        self.capturing: Capturing | None = None
        self.lost: ConnectionLostError | None = None
        self.served_s = clock()
        self._polled_s = float("-inf")
        self.boards = tuple(Board(number, own) for number, own in enumerate(axes, start=1))
        self.links: tuple[Link, ...] = ()
        try:
            for at, url in enumerate(urls):
                own = self.boards if len(urls) == 1 else self.boards[at : at + 1]
                link = Link(
                    open_port(url, baud),
                    url,
                    baud,
                    [board.address for board in own],
                    latency_s,
                    clock,
                    self._receive,
                    partial(self._to_poll, own),
                )
                self.links += (link,)
                for board in own:
                    board.link = link
            opening = Opening(
                robot,
                self.boards,
                baud,
                watch_ms,
                clock=clock,
                pause=pause,
                exchange=self._exchange,
                permit=permit,
            )
            self.trust: Trust = opening.run()
        except BaseException:
            for link in self.links:
                link.close()
            raise
        self.period_ms = opening.period_ms  # between two samples
        self.setpoint_every = opening.setpoint_every  # samples
        for board in self.boards:
            board.telemetry_ms = self.period_ms
            limits = self.trust.limits(board)
            board.link.guard.add(board.address, WireGuard(limits, board.commanded))
            # Its range may be wider than the robot file's: what a board tells is judged by how
            # far it can have gone.
            board.reports = ReadingCheck([_bounds_of(limits[axis.number]) for axis in board.axes])
        self.sampling = Sampling(self.boards, self._named)
        self.served_s = clock()

    @property
    def setpoint_period_s(self) -> float:
        """Between two set-points."""
        return 1e-3 * self.period_ms * self.setpoint_every

    @property
    def silent_s(self) -> float:
        """For how long a board has been missed, as of the latest round; 0 if none is."""
        quiet_s = self.served_s - min(board.telemetry_s for board in self.boards)
        return quiet_s if quiet_s > self._short_s else 0.0

    def board_of(self, axis: str) -> tuple[Board, BoardAxis]:
        """Return the board of an axis, and the axis there."""
        return next((b, one) for b in self.boards for one in b.axes if one.name == axis)

    def close(self) -> None:
        """Stop, end telemetry and close the ports; what a board does not hear its watchdog does.

        Raises
        ------
        ConnectionLostError
            If a port is gone; the others are closed all the same.
        """
        failures: list[ConnectionLostError] = []
        for link in self.links:
            last = [
                encoded(Frame(address, 0xFF, SetTelemetry.TYPE, SetTelemetry(0, 0).packed()))
                for address in link.dialogues
            ]
            try:
                link.close_with(last)
            except ConnectionLostError as error:
                failures.append(error)
        if failures:
            raise failures[0]

    def stopped(self) -> None:
        """Follow up a stop: nothing that was asked before is said any more."""
        if self.player is not None:
            self.player.give_up()
            self.player = None
        for link in self.links:
            link.cancel_pending()
        for board in self.boards:
            board.stop()
        self.trust.cut_off()

    def held_back(self) -> list[str]:
        """Return why the gate has held motion back since the last call, other than for a stop."""
        found: list[str] = []
        for link in self.links:
            error, link.held_back = link.held_back, None
            if error is not None and not isinstance(error, OvertakenError):
                found.append(
                    message("engine", "a motion was not sent: {error}").fill(error=reason_of(error))
                )
        return found

    def serve(self) -> None:
        """Do one round: receive, decide, send.

        Raises
        ------
        ConnectionLostError
            If a port is gone, a board was silent for too long, or was reset.
        """
        if self.lost is not None:
            return
        unserved_s = self._clock() - self.served_s
        if unserved_s > _SHORT_S:
            # While this program did not run it asked nobody: that is no silence of a board.
            for board in self.boards:
                board.telemetry_s += unserved_s
        try:
            for link in self.links:
                link.receive()
            self.served_s = self._clock()
            self._judge()
            self.sampling.gather()
            self._decide(self.served_s)
            for link in self.links:
                link.send()
        except ConnectionLostError as error:
            self.lose(error)
            raise

    def lose(self, error: ConnectionLostError) -> None:
        """Note that the connection is lost: nothing is said any more but a stop."""
        self.lost = error
        if self.player is not None:
            self.player.give_up()
            self.player = None

    def samples(self) -> Samples:
        """Return the samples since the last call."""
        return self.sampling.take()

    def second_time_s(self, time_us: FloatArray) -> FloatArray:
        """Return unwrapped times (n,) of the second board on the clock of the samples, s."""
        first, second = self.boards
        assert first.grid is not None, "telemetry is on"
        assert second.grid is not None, "telemetry is on"
        # Instants of the same number are the same time, whatever each board's clock says.
        number = self.sampling.settled
        shift_us = first.grid.time_us(number) - second.grid.time_us(number)
        return self.sampling.time_s(time_us + shift_us)

    def slow_down(self, board: Board, period_ms: int) -> int:
        """Let a board send telemetry less often, on instants that both boards share.

        Return the period that it has then, ms.
        """
        slower_ms = -(-period_ms // self.period_ms) * self.period_ms
        if slower_ms > board.telemetry_ms:
            self._telemetry(board, slower_ms)
        return slower_ms

    def _exchange(self) -> None:
        for link in self.links:
            link.receive()
            link.send()

    def _decide(self, now_s: float) -> None:
        if self.player is not None and self.player.failure is None:
            self.player.step(now_s, self.sampling.settled)
            if self.player.over and self.player.failure is None:
                self.player = None
        for board in self.boards:
            self._keep_rate(board)
            board.orders.pump(now_s)
            self._keep_alive(board, now_s)
        self._keep_in_step(now_s)

    @property
    def _short_s(self) -> float:
        slowest_ms = max(board.telemetry_ms for board in self.boards)
        # On a shared bus boards speak only when they are polled, one after the other.
        polled_s = max(
            len(link.dialogues) * link.answer_s if link.half_duplex else 0.0 for link in self.links
        )
        return max(_SHORT_S, _SHORT_PERIODS * 1e-3 * slowest_ms, 2.0 * polled_s)

    def _judge(self) -> None:
        for board in self.boards:
            if board.reset:
                raise DeviceResetError(
                    message(
                        "engine",
                        "{where} was reset and has lost its position; reconnect and home",
                    ).fill(where=board.where)
                )
            quiet_s = self.served_s - board.telemetry_s
            if quiet_s > max(LOST_S, 2.0 * self._short_s):
                raise ConnectionLostError(
                    message(
                        "engine",
                        "{where} has not answered for {quiet_s} s; check cable and supply, "
                        "reconnect, then check the position of the machine",
                    ).fill(where=board.where, quiet_s=rounded(quiet_s, 2))
                )

    def _keep_alive(self, board: Board, now_s: float) -> None:
        """Say something before the board's watchdog bites; ask where it is if it is missed."""
        missed = now_s - board.telemetry_s > self._short_s
        often_s = 1e-3 * self._watch_ms / _KEEP_ALIVE
        if not board.keeps_quiet(now_s, often_s):
            return
        request = Request(message=Watch(self._watch_ms), urgency=Urgency.BACKGROUND)
        if missed:  # a board that was reset sends no telemetry, but answers
            request = Request(
                message=Poll(),
                urgency=Urgency.BACKGROUND,
                answer=Telemetry,
                expires_s=now_s + board.link.answer_s,
            )
        board.dialogue.ask(request)

    def _keep_in_step(self, now_s: float) -> None:
        """Begin another board's samples anew when the quartzes have run apart, at rest only."""
        first = self.boards[0]
        assert first.grid is not None, "telemetry is on"
        if self.player is not None or self.silent_s:
            return
        if any(board.telemetry_ms != self.period_ms for board in self.boards):
            return
        for board in self.boards[1:]:
            assert board.grid is not None, "telemetry is on"
            if not board.at_rest or board.busy_line():
                continue
            number = first.number_at(now_s + board.link.answer_s) + 2
            wanted_s = first.clock.host_time_s(first.grid.time_us(number))
            apart_s = board.clock.host_time_s(board.grid.time_us(number)) - wanted_s
            most = _APART_ON_BUS if board.link.half_duplex else _APART
            if abs(apart_s) > most * 1e-3 * self.period_ms:
                board.grid.move(board.clock.time_us(wanted_s), number)
                self._telemetry(board, self.period_ms, number)

    def _telemetry(self, board: Board, period_ms: int, number: int | None = None) -> None:
        assert board.grid is not None, "telemetry is on"
        every = period_ms // self.period_ms
        if number is None:
            number = board.number_at(self._clock() + board.link.answer_s) + 1
            number += -number % every
        begin_us = board.grid.time_us(number) % (1 << 32)
        board.dialogue.ask(
            Request(
                message=SetTelemetry(period_ms, begin_us),
                urgency=Urgency.BACKGROUND,
                answered=lambda _message, _at_s: setattr(board, "telemetry_ms", period_ms),
            )
        )

    def _keep_rate(self, board: Board) -> None:
        """Let a board send less telemetry while it captures, or set-points share the bus with it.

        Asked until it is acknowledged, whatever stop comes between.
        """
        wanted_ms = self.period_ms * (1 if self.player is None else self.setpoint_every)
        capturing = self.capturing
        if capturing is not None and capturing.board is board and not capturing.over:
            wanted_ms = max(wanted_ms, capturing.telemetry_ms)
        if wanted_ms != board.telemetry_ms and not board.dialogue.has(Urgency.BACKGROUND):
            self._telemetry(board, wanted_ms)

    def _receive(self, address: int, message: Message, now_s: float) -> None:
        board = self.boards[address - 1]
        board.receive(message, now_s)
        capturing = self.capturing
        if capturing is None or capturing.board is not board:
            return
        if isinstance(message, Telemetry):
            capturing.sampled()
        elif isinstance(message, Captured):
            capturing.receive(message)

    def _to_poll(self, boards: Sequence[Board], now_s: float) -> int | None:
        """Return which of the boards on a bus has a sample that was not told yet, or both."""
        late = []
        for board in boards:
            if board.grid is None:
                return None
            told, newest = board.grid.number(board.latest_us), board.number_at(now_s)
            newest -= newest % max(board.telemetry_ms // self.period_ms, 1)
            if told is None or newest > told:
                late.append(board)
            elif self.capturing is not None and self.capturing.board is board:
                late += [] if self.capturing.over else [board]
        if not late or now_s - self._polled_s < 2e-3:
            return None
        self._polled_s = now_s
        return BROADCAST if len(late) > 1 else late[0].address

    def _named(self, number: int, row: Row) -> tuple[int, Sequence[tuple[int, ...]]]:
        if self.playback is None:
            return -1, [part.commands for part in row]
        return self.playback.named(number, row)
