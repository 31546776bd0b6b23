"""Session with a GRBL controller: tracks its state and decides which line is sent next.

An alarm is a fault, and ``clear_fault`` resets the controller. Until then a controller that a limit
switch has locked does not answer, but its connection does not count as lost. A stop resets the
controller only after the axes have come to rest, because a reset during motion loses steps. The
reset empties the queue, so that a ``~`` cannot resume it.

A report is used only if it is plausible (``ReadingCheck`` of the driver contract), its state word
is known, and it was requested after the latest command.
"""

import logging
from collections import deque
from collections.abc import Mapping
from contextlib import suppress

import numpy as np

from rotemina.drivers.contract import (
    NEW_POSITION_REPORT_COUNT,
    Clock,
    ConnectionLostError,
    DeviceSamples,
    DeviceState,
    GateError,
    Permit,
)
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.coordinates import StageAxis
from rotemina.drivers.gcode.dialogue import HALT, JOG_CANCEL, RESET, GrblDialogue, ReceivedMessage
from rotemina.drivers.gcode.error_texts import describe_alarm, describe_error
from rotemina.drivers.gcode.grbl_reports import (
    AlarmReport,
    LineAnswer,
    StatusReport,
    WelcomeMessage,
)
from rotemina.drivers.gcode.machine_states import MachineState, interpret_state
from rotemina.drivers.gcode.position_reports import PositionReports
from rotemina.drivers.gcode.straight_move import StraightMove
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_rounded, message

_LOG = logging.getLogger(__name__)
# These times are for a fast line. They are extended by `_TIMEOUT_ROUND_TRIPS` round trips.
_MAX_SILENCE_S, _LOSS_TIMEOUT_S = 0.25, 2.0
# A controller answers a jog as soon as the jog is in its queue.
_ANSWER_TIMEOUT_S = 1.0
_RESET_TIMEOUT_S = 1.0
_TIMEOUT_ROUND_TRIPS = 2.0
#: A longer time between two steps means that this program was suspended. Then all motion is
#: cancelled.
MAX_PAUSE_S = 1.0
# Alarm that a controller reports if a reset ends homing.
_HOMING_RESET_ALARM = 6


class GrblController:
    """An open controller. Repeated calls of :meth:`step` keep it running.

    Any thread may call :meth:`stop`. All other methods belong to the driver's thread.

    Parameters
    ----------
    name : str
        Name of the driver, for the log.
    dialogue : GrblDialogue
    axes : tuple of StageAxis
    settings : ControllerSettings
    status : StatusReport
        Status at the time when the controller was opened. It must have a position.
    clock : Clock
    poll_s, homing_s : float
        Period of status requests, and time limit for homing, s.
    port : str
        Name of the port, for errors.
    """

    def __init__(
        self,
        name: str,
        dialogue: GrblDialogue,
        axes: tuple[StageAxis, ...],
        settings: ControllerSettings,
        status: StatusReport,
        clock: Clock,
        *,
        poll_s: float,
        homing_s: float,
        port: str,
    ) -> None:
        assert status.position is not None, "the handshake refuses a status without a position"
        self.dialogue = dialogue
        self.reports = PositionReports(axes, settings, dialogue.guard)
        self.fault: str | None = None
        self._name, self._settings, self._clock, self._port = name, settings, clock, port
        self._poll_s, self._homing_s = poll_s, homing_s
        self._opened_s = self._last_step_s = self._last_usable_s = clock()
        self._loss_reason: str | None = None
        self._position = status.position
        self._machine = interpret_state(status)
        self._last_query_s = float("-inf")
        # Time since opening, s, and raw position of each report that was not returned yet.
        self._unread_reports: list[tuple[float, tuple[float, ...]]] = []
        # Bytes of stops that any thread has sent. The driver's thread then cancels the motion.
        self._sent_stops: deque[bytes] = deque()
        # Whether a halt was sent. A reset follows as soon as the axes are at rest.
        self._is_halt_sent = False
        # Host time of a reset that the controller has not confirmed yet.
        self._unconfirmed_reset_s: float | None = None
        self._targets: dict[str, float] = {}
        self._speeds: dict[str, float] = {}
        self._permit: Permit | None = None
        self._move: StraightMove | None = None
        # Homing lines that are not complete, each with its axes. The first line is being executed.
        self._homing_queue: deque[tuple[str, tuple[str, ...]]] = deque()
        # Axes whose switch was found. The next reports determine their positions.
        self._homed_axes: set[str] = set()
        self._unlock_pending = False
        # After an alarm the controller may respond to nothing except a reset.
        self._needs_reset = False

    def accept_step_count(self) -> None:
        """Accept the controller's step count as the position of each axis that is in its range."""
        if not self._machine.position_lost:
            self.reports.accept_step_count(self._position)

    @property
    def stop_pending(self) -> bool:
        """Whether a stop is incomplete: the axes must come to rest and the queue be emptied."""
        return bool(self._sent_stops) or self._is_halt_sent or self._unconfirmed_reset_s is not None

    @property
    def state(self) -> DeviceState:
        """The state of the controller."""
        if self.fault is not None:
            return DeviceState.FAULT
        if self._homing_queue or self._homed_axes:
            return DeviceState.HOMING
        if self._targets or self._machine.is_moving:
            return DeviceState.MOVING
        return DeviceState.IDLE

    @property
    def silent_s(self) -> float:
        """Time since the last usable message, s; 0 if that is short enough."""
        if self._is_silence_expected():
            return 0.0
        last_usable_s = min(self.dialogue.last_received_s, self._last_usable_s)
        silent_s = self._clock() - last_usable_s
        return silent_s if silent_s > self._extend_timeout(_MAX_SILENCE_S) else 0.0

    @property
    def is_braking(self) -> bool:
        """Whether axes may be moving or braking."""
        return self._is_halt_sent or self._machine.is_moving

    @property
    def is_unreachable(self) -> bool:
        """Whether the controller does not respond: its line is lost, or an alarm has locked it."""
        return self._loss_reason is not None or self._needs_reset

    @property
    def is_homing(self) -> bool:
        """Whether the controller searches for limit switches."""
        return bool(self._homing_queue)

    @property
    def is_ready(self) -> bool:
        """Whether a line may be sent now."""
        return (
            self.dialogue.pending_line is None
            and not self._sent_stops
            and not self._is_halt_sent
            and self._unconfirmed_reset_s is None
            and self.fault is None
        )

    def move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        """Start to move axes, m or rad, no faster than ``speeds``, or change the current move."""
        targets = {**self._targets, **targets}
        speeds = {
            **{name: speed for name, speed in self._speeds.items() if name not in targets},
            **speeds,
        }
        is_moving = self._move is not None
        move = None
        if not is_moving and self.is_ready and not self.reports.is_in_doubt:
            move = self._make_move(targets, speeds)
            if move is None:
                return
        with permit.passing():
            if move is not None:
                line = move.make_next_line(self._position, on_trial=self.reports.untried_axes)
                assert line is not None, "a new move always has a first piece"
                self.dialogue.send_line(line)
            elif is_moving:
                # The controller brakes and discards the old move. Then the new move begins.
                self.dialogue.send_realtime(JOG_CANCEL)
                self._expect_braking()
        self._targets, self._speeds, self._permit, self._move = targets, speeds, permit, move

    def stop(self) -> None:
        """Halt all axes. Any thread may call it."""
        # During homing a controller ignores a feed hold, so it is reset. This loses no position,
        # because the position is unknown anyway.
        data = RESET if self._homing_queue else HALT
        self._sent_stops.append(data)
        # If the connection is lost, the next call of `step` raises the error.
        with suppress(ConnectionLostError):
            self.dialogue.send_realtime(data)

    def clear_fault(self, permit: Permit) -> None:
        """Reset the controller and clear the fault."""
        with permit.passing():
            self.dialogue.send_realtime(RESET)
        self._begin_reset()
        self.dialogue.resume_after_pause()
        self._last_usable_s = self._clock()
        self.fault = None
        self._needs_reset = False
        # Without homing only an unlock ($X) ends an alarm; the position stays unknown.
        self._unlock_pending = not self._settings.can_home

    def home(self, lines: deque[tuple[str, tuple[str, ...]]], permit: Permit) -> None:
        """Start homing. The lines are sent one after the other; each is given with its axes."""
        with permit.passing():
            # This is set before the line is sent, so that a stop right afterwards causes a reset.
            self._homing_queue = lines
            self.reports.forget_positions(axis for _, axes in lines for axis in axes)
            self.dialogue.send_line(lines[0][0])
        self._permit = permit

    def step(self, now_s: float) -> DeviceSamples:
        """Process received messages, send the next line, and return the new samples.

        Raises
        ------
        ConnectionLostError
            If the controller has been silent for too long.
        """
        if self._loss_reason is not None:
            raise ConnectionLostError(self._loss_reason)
        self._handle_pause(now_s)
        self._apply_stops()
        self.dialogue.may_be_silent = self._is_silence_expected()
        for reception in self.dialogue.receive():
            self._handle_message(reception)
        self._reset_if_at_rest()
        self._send_next()
        self._check_timeouts(now_s)
        self.dialogue.request_status(self._poll_s, self._last_query_s)
        query_sent_s = self.dialogue.query_sent_s
        self._last_query_s = query_sent_s if query_sent_s is not None else self._last_query_s
        return self._take_samples()

    def _handle_message(self, reception: ReceivedMessage) -> None:
        report = reception.message
        if isinstance(report, StatusReport):
            self._handle_status(report, reception)
        elif isinstance(report, LineAnswer):
            self._handle_answer(report)
        elif isinstance(report, AlarmReport):
            self._handle_alarm(report)
        elif isinstance(report, WelcomeMessage):
            self._handle_welcome()

    def _handle_status(self, status: StatusReport, reception: ReceivedMessage) -> None:
        if not self.reports.is_usable(status, reception):
            self.dialogue.count_discarded()
            if self.reports.shows_new_position:
                self.reports.accept_any_position()
                self.reports.forget_positions(self.reports.axis_names)
                self._halt_with_fault(
                    message(
                        "engine",
                        "{count} reports in a row agree on a position that the axes cannot have "
                        "reached by themselves; the position is unknown. Home all axes",
                    ).fill(count=NEW_POSITION_REPORT_COUNT)
                )
            return
        assert status.position is not None, "a usable status has a position"
        self._last_usable_s = reception.received_s
        self._needs_reset = False
        if reception.time_s is not None:
            self._unread_reports.append((reception.time_s - self._opened_s, status.position))
        if not reception.is_fresh:
            return
        machine = interpret_state(status)
        if not machine.is_recognized:
            # An unknown state may mean motion. The axes count as moving if the position changes.
            machine = MachineState(status.position != self._position, machine.fault)
        is_at_rest = not machine.is_moving and status.position == self._position
        self._position, self._machine = status.position, machine
        self._repeat_halt()
        if self._homed_axes and is_at_rest:
            self._locate_homed_axes(reception.requested_s)
        self._apply_machine_state()
        self._check_arrival()

    def _apply_machine_state(self) -> None:
        """Report a fault if the machine state forbids motion."""
        machine = self._machine
        # A stop causes a feed hold, and an alarm remains until homing. Neither is a new fault.
        is_own_hold = self.stop_pending and machine.is_hold
        was_locked_before = (
            machine.position_lost and not self.reports.known_axes and self._move is None
        )
        if machine.position_lost:
            self.reports.forget_positions(self.reports.axis_names)
        if machine.fault is None or self.fault is not None or self._homing_queue:
            return
        if is_own_hold or (machine.is_alarm and was_locked_before):
            return
        _LOG.warning("%s: %s", self._name, machine.fault)
        self._end_move()
        self.fault = machine.fault

    def _locate_homed_axes(self, taken_s: float) -> None:
        """Determine the positions of homed axes, on which two consecutive reports have agreed."""
        axes, self._homed_axes = self._homed_axes, set()
        try:
            self.reports.locate_axes(axes, self._position, taken_s)
        except InputError as error:
            _LOG.warning("%s: %s", self._name, error)
            self._end_move()
            self.fault = str(error)

    def _check_arrival(self) -> None:
        """End a move that has reached its target or left its path."""
        move = self._move
        if move is None:
            return
        if stray_text := move.describe_path_deviation(self._position):
            self.reports.forget_positions(axis.name for axis in move.axes)
            self._halt_with_fault(stray_text)
            return
        self.reports.confirm_direction(move.find_confirmed_axes(self._position))
        if self._machine.is_moving or self.dialogue.pending_line is not None or self._is_halt_sent:
            return
        untried = [axis.name for axis in move.axes if axis.name in self.reports.untried_axes]
        if not move.is_fully_sent and not untried:
            return
        if miss_text := move.describe_position_error(self._position):
            self._halt_with_fault(
                message("engine", "the move ended before its target: {short}").fill(short=miss_text)
            )
        else:
            self._end_move()

    def _handle_answer(self, answer: LineAnswer) -> None:
        line, self.dialogue.pending_line = self.dialogue.pending_line, None
        self._repeat_halt()
        if line is None:
            return
        if answer.error is not None:
            self._halt_with_fault(
                message("engine", "the controller refused {line}: {text}").fill(
                    line=repr(line), text=describe_error(answer.error, self._settings.firmware)
                ),
            )
        elif self._homing_queue and line == self._homing_queue[0][0]:
            self._homed_axes |= set(self._homing_queue.popleft()[1])
            # Some controllers answer no query during homing, but answer the last one afterwards.
            self.dialogue.abandon_query()
            self.reports.accept_any_position()
            self._last_usable_s = self._clock()

    def _handle_alarm(self, alarm: AlarmReport) -> None:
        self.dialogue.stop_waiting()
        self._machine = MachineState()
        self._is_halt_sent = False
        self._end_move()
        self._homing_queue.clear()
        self._homed_axes.clear()
        self.reports.forget_positions(self.reports.axis_names)
        self._needs_reset = True
        # A stop during homing always causes this alarm, which is therefore not a fault.
        if alarm.number != _HOMING_RESET_ALARM or not self.stop_pending:
            self.fault = describe_alarm(alarm.number, self._settings.firmware)
            _LOG.warning("%s: %s", self._name, self.fault)

    def _handle_welcome(self) -> None:
        if self._unconfirmed_reset_s is None and not self._sent_stops and self.fault is None:
            self.reports.forget_positions(self.reports.axis_names)
            self.fault = message(
                "engine",
                "the controller was reset externally or lost power; clear the fault, then home",
            )
        self._needs_reset = False
        self._unconfirmed_reset_s = None
        self._homing_queue.clear()
        self._homed_axes.clear()
        self._end_move(keep_request=self._is_request_valid())
        self.dialogue.stop_waiting()

    def _is_request_valid(self) -> bool:
        """Return whether the current request was made after the stop that caused the reset."""
        return self._permit is not None and self._permit.is_valid and self.fault is None

    def _handle_pause(self, now_s: float) -> None:
        """Cancel all motion if this program was suspended and therefore did not supervise it."""
        paused_s, self._last_step_s = now_s - self._last_step_s, now_s
        if paused_s <= MAX_PAUSE_S:
            return
        self.dialogue.resume_after_pause()
        self._last_usable_s = now_s
        if self._move is None and not self._targets and not self._homing_queue:
            return
        _LOG.warning(
            "%s: this program was suspended for %.1f s; the motion is cancelled",
            self._name,
            paused_s,
        )
        self._permit = None
        self.stop()

    def _apply_stops(self) -> None:
        while self._sent_stops:
            if self._sent_stops.popleft() == RESET:
                self._homing_queue.clear()
                self._begin_reset()
            else:
                self._is_halt_sent = True
                self._expect_braking()
            self._end_move(keep_request=self._is_request_valid() and self._move is None)

    def _repeat_halt(self) -> None:
        """Repeat a halt while axes move.

        The halt may have overtaken a line, which then starts a new jog.
        """
        if self._is_halt_sent and self._machine.is_moving:
            self.dialogue.send_realtime(HALT)
            self._expect_braking()

    def _reset_if_at_rest(self) -> None:
        if self._is_halt_sent and not self._machine.is_moving and self._unconfirmed_reset_s is None:
            self.dialogue.send_realtime(RESET)
            self._begin_reset()

    def _expect_braking(self) -> None:
        """Assume that the axes are braking, until a newly requested report shows otherwise."""
        self.dialogue.invalidate_reports()
        self._machine = MachineState(is_moving=True)

    def _begin_reset(self) -> None:
        self._unconfirmed_reset_s = self._clock()
        # This reset completes the halt. A later halt needs another reset.
        self._is_halt_sent = False
        self.dialogue.stop_waiting()

    def _send_next(self) -> None:
        if not self.is_ready:
            return
        if self._unlock_pending:
            self._unlock_pending = False
            self.dialogue.send_line("$X")
        if self._permit is None or self.dialogue.pending_line is not None:
            return
        try:
            if self._homing_queue:
                with self._permit.passing(begins=False):
                    self.dialogue.send_line(self._homing_queue[0][0])
            elif self._targets:
                self._send_next_piece(self._permit)
        except GateError as error:
            _LOG.info("%s: %s", self._name, error)
            self._homing_queue.clear()
            self._end_move()

    def _send_next_piece(self, permit: Permit) -> None:
        is_first_piece = self._move is None
        if self._move is None:
            # The move must wait while the axes brake or their position is in doubt.
            if self._machine.is_moving or self.reports.is_in_doubt:
                return
            self._move = self._make_move(self._targets, self._speeds)
            if self._move is None:
                self._end_move()
                return
        line = self._move.make_next_line(self._position, on_trial=self.reports.untried_axes)
        if line is not None:
            with permit.passing(begins=is_first_piece):
                self.dialogue.send_line(line)

    def _make_move(
        self, targets: Mapping[str, float], speeds: Mapping[str, float]
    ) -> StraightMove | None:
        return StraightMove.of(
            self.reports.axes, self._position, targets, speeds, self.dialogue.round_trip_s
        )

    def _is_silence_expected(self) -> bool:
        return bool(self._homing_queue) or self._needs_reset

    def _end_move(self, *, keep_request: bool = False) -> None:
        self._move = None
        if not keep_request:
            self._targets, self._speeds = {}, {}

    def _halt_with_fault(self, fault: str) -> None:
        _LOG.warning("%s: %s", self._name, fault)
        self._homing_queue.clear()
        self._end_move()
        self.fault = fault
        self.dialogue.send_realtime(HALT)
        self._is_halt_sent = True
        self._expect_braking()

    def _extend_timeout(self, seconds: float) -> float:
        return seconds + _TIMEOUT_ROUND_TRIPS * self.dialogue.round_trip_s

    def _check_timeouts(self, now_s: float) -> None:
        if (
            self._unconfirmed_reset_s is not None
            and now_s - self._unconfirmed_reset_s > self._extend_timeout(_RESET_TIMEOUT_S)
        ):
            self.dialogue.send_realtime(RESET)
            self._unconfirmed_reset_s = now_s
        timeout_s = (
            self._homing_s if self._homing_queue else self._extend_timeout(_ANSWER_TIMEOUT_S)
        )
        pending_line, since_s = self.dialogue.pending_line, self.dialogue.pending_since_s
        silent_s = now_s - self.dialogue.last_received_s
        if pending_line is not None and now_s - since_s > timeout_s:
            self.dialogue.stop_waiting()
            if silent_s < self._extend_timeout(_MAX_SILENCE_S) or self._homing_queue:
                self._halt_with_fault(
                    message("engine", "no answer to {line} within {limit_s} s").fill(
                        line=repr(pending_line), limit_s=format_rounded(timeout_s, 2)
                    ),
                )
        if self._is_silence_expected():
            return
        loss_timeout_s = self._extend_timeout(_LOSS_TIMEOUT_S)
        if silent_s > loss_timeout_s:
            self._loss_reason = message(
                "engine",
                "{port}: the controller has not answered for {seconds} s; its motion ends "
                "within half a second plus the braking time. Check the machine, then "
                "reconnect",
            ).fill(port=self._port, seconds=format_rounded(loss_timeout_s, 2))
            raise ConnectionLostError(self._loss_reason)
        if now_s - self._last_usable_s > loss_timeout_s and self.fault is None:
            self.reports.forget_positions(self.reports.axis_names)
            self._halt_with_fault(
                message(
                    "engine",
                    "no report in the last {seconds} s was usable; check the cable, then clear the "
                    "fault and home",
                ).fill(seconds=format_rounded(loss_timeout_s, 2))
            )

    def _take_samples(self) -> DeviceSamples:
        reports, self._unread_reports = self._unread_reports, []
        if not reports:
            return DeviceSamples.empty(len(self.reports.axes))
        position = np.array([self.reports.convert_position(raw) for _, raw in reports])
        no_inputs = np.full(position.shape, np.nan)
        time_s = np.array([time_s for time_s, _ in reports])
        return DeviceSamples(time_s, position, position, no_inputs, np.full(len(reports), -1))
