"""Open connection to the boards: links, boards, telemetry, playback and captures."""

from collections.abc import Callable, Sequence
from functools import partial
from math import inf

from rotemina.drivers.abilities import VOLTAGE_SLEW_RANGES_PER_S
from rotemina.drivers.contract import (
    Clock,
    ConnectionLostError,
    DeviceResetError,
    DeviceSamples,
    Permit,
    ReadingBounds,
    ReadingCheck,
    StalePermitError,
)
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.board_discovery import BoardHandshake
from rotemina.drivers.mc68hc11.capturing import BoardCapture
from rotemina.drivers.mc68hc11.dialogue import BoardRequest, RequestUrgency
from rotemina.drivers.mc68hc11.parameter_check import ParameterCheck
from rotemina.drivers.mc68hc11.protocol import (
    BROADCAST_ADDRESS,
    BoardAxis,
    CaptureSamples,
    PollBoard,
    SerialFrame,
    SetTelemetry,
    SetWatchdog,
    Telemetry,
    WireMessage,
    encode_frame,
)
from rotemina.drivers.mc68hc11.sampling import SampleAssembler, SampleRow
from rotemina.drivers.mc68hc11.segment_player import SegmentPlayer
from rotemina.drivers.mc68hc11.serial_link import SerialLink
from rotemina.drivers.mc68hc11.wire_guard import StepLimits, WireGuard
from rotemina.drivers.serial_lines import OpenPort
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import describe_exception
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.robot import Robot

# After this time without telemetry the connection is lost.
MAX_TELEMETRY_GAP_S = 0.5
# A board counts as silent after the longer of this time and this many periods without telemetry.
_MIN_SILENCE_S = 0.1
_MIN_SILENCE_PERIODS = 3.5
# At least this many messages are sent to a board within its watchdog time.
_KEEP_ALIVE_PER_WATCHDOG = 4
# If the sampling instants of the boards differ by more than this, they are synchronized again.
_MAX_SKEW_PERIODS = 0.5
# On a shared bus the clock estimates are less accurate, because they depend on the polls.
_MAX_BUS_SKEW_PERIODS = 1.5
# A reported command is the sum of a reading and a deviation, each with a rounding error.
_COMMAND_TOLERANCE_STEPS = 2.0
# Minimum interval between two polls of a shared bus.
_MIN_POLL_INTERVAL_S = 2e-3


def _make_reading_bounds(limits: StepLimits) -> ReadingBounds:
    """Return bounds for the reported commands of an axis, steps.

    If its voltage is set directly, a piezo moves at up to `VOLTAGE_SLEW_RANGES_PER_S`, which may
    exceed ``max_speed``.
    """
    speed = max(limits.max_speed, VOLTAGE_SLEW_RANGES_PER_S * (limits.high - limits.low))
    return ReadingBounds(-inf, inf, speed, _COMMAND_TOLERANCE_STEPS)


class BoardSession:
    """Open connection to the boards.

    Parameters
    ----------
    robot : Robot
    axes : sequence of tuple of BoardAxis
        Axes of each board.
    urls : sequence of str
        URL of one line for all boards, or one URL for each board.
    baud : int
    latency_s : float
        Time that the operating system and adapters may add to a round trip.
    watchdog_ms : int
        Time without a message from the host after which a board halts.
    clock : callable
        Return the host time, s.
    pause : callable
        Wait for some seconds.
    open_port : callable
        Return an open port for a URL and a baud rate.
    permit : Permit
        Permit for clearing faults that occurred before this connection.

    Attributes
    ----------
    player : SegmentPlayer or None
        The running playback.
    latest_player : SegmentPlayer or None
        The latest playback, running or not. It determines the trajectory row of each sample.
    capture : BoardCapture or None
    loss : ConnectionLostError or None
        The reason if the connection is lost.
    """

    def __init__(
        self,
        robot: Robot,
        axes: Sequence[tuple[BoardAxis, ...]],
        urls: Sequence[str],
        baud: int,
        *,
        latency_s: float,
        watchdog_ms: int,
        clock: Clock,
        pause: Callable[[float], None],
        open_port: OpenPort,
        permit: Permit,
    ) -> None:
        self._clock = clock
        self._watchdog_ms = watchdog_ms
        # Replaced when the boards have reported their rates.
        self.period_ms = 1
        self.player: SegmentPlayer | None = None
        self.latest_player: SegmentPlayer | None = None
        self.capture: BoardCapture | None = None
        self.loss: ConnectionLostError | None = None
        self.last_served_s = clock()
        self._last_poll_s = float("-inf")
        self.boards = tuple(
            Board(number, board_axes) for number, board_axes in enumerate(axes, start=1)
        )
        self.links: tuple[SerialLink, ...] = ()
        try:
            for index, url in enumerate(urls):
                boards_on_link = self.boards if len(urls) == 1 else self.boards[index : index + 1]
                link = SerialLink(
                    open_port(url, baud),
                    url,
                    baud,
                    [board.address for board in boards_on_link],
                    latency_s,
                    clock,
                    self._receive,
                    partial(self._choose_poll_address, boards_on_link),
                )
                self.links += (link,)
                for board in boards_on_link:
                    board.link = link
            handshake = BoardHandshake(
                robot,
                self.boards,
                baud,
                watchdog_ms,
                clock=clock,
                pause=pause,
                exchange=self._exchange,
                permit=permit,
            )
            self.parameter_check: ParameterCheck = handshake.run()
        except BaseException:
            for link in self.links:
                link.close()
            raise
        self.period_ms = handshake.period_ms
        self.samples_per_setpoint = handshake.samples_per_setpoint
        for board in self.boards:
            board.telemetry_period_ms = self.period_ms
            limits = self.parameter_check.make_step_limits(board)
            board.link.guard.add(board.address, WireGuard(limits, board.read_commands))
            # The range of a board may be wider than that of the robot file. So a report is only
            # checked for the distance that an axis can have moved, not for the range.
            board.reading_check = ReadingCheck(
                [_make_reading_bounds(limits[axis.number]) for axis in board.axes]
            )
        self.sample_assembler = SampleAssembler(self.boards, self._find_trajectory_row)
        self.last_served_s = clock()

    @property
    def setpoint_period_s(self) -> float:
        """Interval between two set-points, s."""
        return 1e-3 * self.period_ms * self.samples_per_setpoint

    @property
    def silent_s(self) -> float:
        """Time for which a board was silent at the latest :meth:`serve`, s; 0 if no board was."""
        silent_s = self.last_served_s - min(board.last_telemetry_s for board in self.boards)
        return silent_s if silent_s > self._silence_limit_s else 0.0

    def find_axis(self, axis: str) -> tuple[Board, BoardAxis]:
        """Return the board of an axis, and the axis on that board."""
        return next(
            (board, board_axis)
            for board in self.boards
            for board_axis in board.axes
            if board_axis.name == axis
        )

    def close(self) -> None:
        """Stop the boards, end telemetry and close the ports.

        The watchdog halts a board that does not receive the stop.

        Raises
        ------
        ConnectionLostError
            If a port does not exist any more. The other ports are still closed.
        """
        failures: list[ConnectionLostError] = []
        for link in self.links:
            last_frames = [
                encode_frame(
                    SerialFrame(address, 0xFF, SetTelemetry.TYPE, SetTelemetry(0, 0).pack())
                )
                for address in link.dialogues
            ]
            try:
                link.close_with_frames(last_frames)
            except ConnectionLostError as error:
                failures.append(error)
        if failures:
            raise failures[0]

    def handle_stop(self) -> None:
        """Complete a stop: cancel all earlier requests, and send stop until it is acknowledged."""
        if self.player is not None:
            self.player.abort()
            self.player = None
        for link in self.links:
            link.cancel_pending()
        for board in self.boards:
            board.stop()
        self.parameter_check.note_stop()

    def take_rejection_reasons(self) -> list[str]:
        """Return the reasons why the gate has held back motion since the last call.

        Motion that a stop has cancelled is not included.
        """
        reasons: list[str] = []
        for link in self.links:
            error, link.hold_back_error = link.hold_back_error, None
            if error is not None and not isinstance(error, StalePermitError):
                reasons.append(
                    message("engine", "a motion was not sent: {error}").fill(
                        error=describe_exception(error)
                    )
                )
        return reasons

    def serve(self) -> None:
        """Receive frames, update the state of the boards, and send the next frames.

        Raises
        ------
        ConnectionLostError
            If a port does not exist any more, or a board was silent for too long or was reset.
        """
        if self.loss is not None:
            return
        unserved_s = self._clock() - self.last_served_s
        if unserved_s > _MIN_SILENCE_S:
            # This program did not run and could not receive, so the boards do not count as silent.
            for board in self.boards:
                board.last_telemetry_s += unserved_s
        try:
            for link in self.links:
                link.receive()
            self.last_served_s = self._clock()
            self._check_connection()
            self.sample_assembler.collect_samples()
            self._update_boards(self.last_served_s)
            for link in self.links:
                link.send()
        except ConnectionLostError as error:
            self.note_loss(error)
            raise

    def note_loss(self, error: ConnectionLostError) -> None:
        """Record that the connection is lost. From now on nothing but a stop is sent."""
        self.loss = error
        if self.player is not None:
            self.player.abort()
            self.player = None

    def take_samples(self) -> DeviceSamples:
        """Return the samples since the last call."""
        return self.sample_assembler.take_rows()

    def second_board_to_device_time_s(self, time_us: FloatArray) -> FloatArray:
        """Return the device times, s, of unwrapped times (n,) of the second board."""
        first, second = self.boards
        assert first.grid is not None, "telemetry must be on"
        assert second.grid is not None, "telemetry must be on"
        # Instants with the same number are simultaneous, although the clocks differ.
        number = self.sample_assembler.latest_finished_number
        shift_us = first.grid.find_time_us(number) - second.grid.find_time_us(number)
        return self.sample_assembler.to_device_time_s(time_us + shift_us)

    def slow_telemetry(self, board: Board, period_ms: int) -> int:
        """Reduce the telemetry rate of a board.

        The new period is a multiple of the common period, so the board's sampling instants still
        coincide with those of the other boards.

        Returns
        -------
        int
            The new period, ms, at least ``period_ms``.
        """
        reduced_period_ms = -(-period_ms // self.period_ms) * self.period_ms
        if reduced_period_ms > board.telemetry_period_ms:
            self._request_telemetry(board, reduced_period_ms)
        return reduced_period_ms

    def _exchange(self) -> None:
        for link in self.links:
            link.receive()
            link.send()

    def _update_boards(self, now_s: float) -> None:
        if self.player is not None and self.player.failure is None:
            self.player.advance(now_s, self.sample_assembler.latest_finished_number)
            if self.player.is_over and self.player.failure is None:
                self.player = None
        for board in self.boards:
            self._adjust_telemetry_rate(board)
            board.orders.send_next(now_s)
            self._keep_alive(board, now_s)
        self._resynchronize_samples(now_s)

    @property
    def _silence_limit_s(self) -> float:
        longest_period_ms = max(board.telemetry_period_ms for board in self.boards)
        # On a shared bus boards send only when they are polled, one after the other.
        poll_cycle_s = max(
            len(link.dialogues) * link.answer_s if link.half_duplex else 0.0 for link in self.links
        )
        return max(
            _MIN_SILENCE_S, _MIN_SILENCE_PERIODS * 1e-3 * longest_period_ms, 2.0 * poll_cycle_s
        )

    def _check_connection(self) -> None:
        for board in self.boards:
            if board.was_reset:
                raise DeviceResetError(
                    "{where} was reset and has lost its position; reconnect and home",
                    where=board.where,
                )
            quiet_s = self.last_served_s - board.last_telemetry_s
            if quiet_s > max(MAX_TELEMETRY_GAP_S, 2.0 * self._silence_limit_s):
                raise ConnectionLostError(
                    "{where} has not answered for {quiet_s} s; check cable and supply, "
                    "reconnect, then check the position of the machine",
                    where=board.where,
                    quiet_s=format_rounded(quiet_s, 2),
                )

    def _keep_alive(self, board: Board, now_s: float) -> None:
        """Send the board a message before its watchdog expires; a poll if the board is silent."""
        has_lost_telemetry = now_s - board.last_telemetry_s > self._silence_limit_s
        period_s = 1e-3 * self._watchdog_ms / _KEEP_ALIVE_PER_WATCHDOG
        if not board.needs_keep_alive(now_s, period_s):
            return
        request = BoardRequest(
            message=SetWatchdog(self._watchdog_ms), urgency=RequestUrgency.BACKGROUND
        )
        if has_lost_telemetry:
            # A board that was reset sends no telemetry, but it answers a poll.
            request = BoardRequest(
                message=PollBoard(),
                urgency=RequestUrgency.BACKGROUND,
                answer_type=Telemetry,
                expires_s=now_s + board.link.answer_s,
            )
        board.dialogue.ask(request)

    def _resynchronize_samples(self, now_s: float) -> None:
        """Realign the sampling instants of each board whose clock has drifted from the first one's.

        A board that moves or has pending requests is left out. Nothing is realigned during a
        playback, while a board is silent, or while a telemetry rate is reduced.
        """
        first = self.boards[0]
        assert first.grid is not None, "telemetry must be on"
        if self.player is not None or self.silent_s:
            return
        if any(board.telemetry_period_ms != self.period_ms for board in self.boards):
            return
        for board in self.boards[1:]:
            assert board.grid is not None, "telemetry must be on"
            if not board.at_rest or board.has_pending_requests():
                continue
            number = first.find_sample_number(now_s + board.link.answer_s) + 2
            target_s = first.clock.to_host_time_s(first.grid.find_time_us(number))
            skew_s = board.clock.to_host_time_s(board.grid.find_time_us(number)) - target_s
            max_skew_periods = (
                _MAX_BUS_SKEW_PERIODS if board.link.half_duplex else _MAX_SKEW_PERIODS
            )
            if abs(skew_s) > max_skew_periods * 1e-3 * self.period_ms:
                board.grid.shift(board.clock.to_board_time_us(target_s), number)
                self._request_telemetry(board, self.period_ms, number)

    def _request_telemetry(self, board: Board, period_ms: int, number: int | None = None) -> None:
        assert board.grid is not None, "telemetry must be on"
        instant_spacing = period_ms // self.period_ms
        if number is None:
            number = board.find_sample_number(self._clock() + board.link.answer_s) + 1
            number += -number % instant_spacing
        begin_us = board.grid.find_time_us(number) % (1 << 32)
        board.dialogue.ask(
            BoardRequest(
                message=SetTelemetry(period_ms, begin_us),
                urgency=RequestUrgency.BACKGROUND,
                on_answer=lambda _message, _now_s: setattr(board, "telemetry_period_ms", period_ms),
            )
        )

    def _adjust_telemetry_rate(self, board: Board) -> None:
        """Reduce the telemetry rate of a board during a capture, or during a playback on a bus.

        The request is repeated until it is acknowledged, also after a stop.
        """
        # Only on a shared bus is there more than one sample per set-point.
        period_ms = self.period_ms * (1 if self.player is None else self.samples_per_setpoint)
        capture = self.capture
        if capture is not None and capture.board is board and not capture.is_over:
            period_ms = max(period_ms, capture.telemetry_period_ms)
        if period_ms != board.telemetry_period_ms and not board.dialogue.has_request(
            RequestUrgency.BACKGROUND
        ):
            self._request_telemetry(board, period_ms)

    def _receive(self, address: int, wire_message: WireMessage, now_s: float) -> None:
        board = self.boards[address - 1]
        board.receive(wire_message, now_s)
        capture = self.capture
        if capture is None or capture.board is not board:
            return
        if isinstance(wire_message, Telemetry):
            capture.check_telemetry()
        elif isinstance(wire_message, CaptureSamples):
            capture.receive(wire_message)

    def _choose_poll_address(self, boards: Sequence[Board], now_s: float) -> int | None:
        """Return the address of the board on a bus that is to be polled next.

        Return the broadcast address if several boards have new data, or None if no board has.
        """
        due_boards = []
        for board in boards:
            if board.grid is None:
                return None
            received_number, latest_number = (
                board.grid.find_number(board.latest_us),
                board.find_sample_number(now_s),
            )
            latest_number -= latest_number % max(board.telemetry_period_ms // self.period_ms, 1)
            if received_number is None or latest_number > received_number:
                due_boards.append(board)
            elif self.capture is not None and self.capture.board is board:
                due_boards += [] if self.capture.is_over else [board]
        if not due_boards or now_s - self._last_poll_s < _MIN_POLL_INTERVAL_S:
            return None
        self._last_poll_s = now_s
        return BROADCAST_ADDRESS if len(due_boards) > 1 else due_boards[0].address

    def _find_trajectory_row(
        self, number: int, sample_row: SampleRow
    ) -> tuple[int, Sequence[tuple[int, ...]]]:
        """Return the trajectory row that took effect at an instant, and each board's commands.

        ``number`` is the number of the instant, and ``sample_row`` has the sample of each board.
        The trajectory row is -1 if none took effect. The commands are in steps.
        """
        if self.latest_player is None:
            return -1, [sample.commands for sample in sample_row]
        return self.latest_player.find_row(number, sample_row)
