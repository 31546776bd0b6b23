"""The state of a GRBL controller, and what to send it next.

An alarm is a fault, which ``clear_fault`` resets; until then a controller that a switch has locked
does not answer, but its line is not lost. A stop resets it only after the axes have come to rest,
because a reset in motion loses steps; the reset empties the queue, so that no ``~`` resumes it.

A report is used only if it is plausible (:mod:`rotemina.drivers.reading_check`), its state word is
known, and it was requested after the latest command.
"""

import logging
from collections import deque
from collections.abc import Mapping
from contextlib import suppress

import numpy as np

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.gate import GateError, Permit
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.coordinates import StageAxis
from rotemina.drivers.gcode.dialogue import HALT, JOG_CANCEL, RESET, Dialogue, Reception
from rotemina.drivers.gcode.error_texts import describe_alarm, describe_error
from rotemina.drivers.gcode.grbl_reports import Alarm, Answer, Status, Welcome
from rotemina.drivers.gcode.machine_states import MachineState, interpret_state
from rotemina.drivers.gcode.position_reports import PositionReports
from rotemina.drivers.gcode.straight_move import StraightMove
from rotemina.drivers.reading_check import REPORTS_OF_A_NEW_POSITION
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

_LOG = logging.getLogger(__name__)
# Of a fast line; a slow one has two round trips more.
_SILENT_S, _LOST_S = 0.25, 2.0
_LINE_S = 1.0  # for an answer to a jog: it is given when the line is in the queue
_RESET_S = 1.0
_WAITING_ROUND_TRIPS = 2.0
#: After so long without a step this program was suspended: nothing may go on by itself.
MAX_PAUSE_S = 1.0
# A homing that is reset ends with this alarm.
_HOMING_RESET_ALARM = 6


class Controller:
    """One controller that was opened; what it does is followed in steps.

    Any thread may call :meth:`stop`; all else is the driver's own thread's.

    Parameters
    ----------
    name : str
        The driver's, for the log.
    dialogue : Dialogue
    axes : tuple of StageAxis
    settings : ControllerSettings
    status : Status
        What it said when it was opened; it has a position.
    clock : Clock
    poll_s, homing_s : float
        How often a report is requested, and how long a search for switches may take.
    port : str
        For errors.
    """

    def __init__(
        self,
        name: str,
        dialogue: Dialogue,
        axes: tuple[StageAxis, ...],
        settings: ControllerSettings,
        status: Status,
        clock: Clock,
        *,
        poll_s: float,
        homing_s: float,
        port: str,
    ) -> None:
        assert status.position is not None, "the opening refuses one without"
        self.dialogue = dialogue
        self.reports = PositionReports(axes, settings, dialogue.guard)
        self.fault: str | None = None
        self._name, self._settings, self._clock, self._port = name, settings, clock, port
        self._poll_s, self._homing_s = poll_s, homing_s
        self._opened_s = self._stepped_s = self._used_s = clock()
        self._lost: str | None = None
        self._position = status.position
        self._machine = interpret_state(status)
        self._asked_s = float("-inf")
        self._rows: list[tuple[float, tuple[float, ...]]] = []
        # Written by whichever thread stops, compared by the driver's own.
        self._stops: deque[bytes] = deque()
        self._braking = False  # told to halt: a reset follows once the axes rest
        self._reset_s: float | None = None  # since when a reset is to be confirmed
        self._targets: dict[str, float] = {}
        self._speeds: dict[str, float] = {}
        self._permit: Permit | None = None
        self._move: StraightMove | None = None
        self._searches: deque[tuple[str, tuple[str, ...]]] = deque()  # line, axes; first: now
        self._homed: set[str] = set()  # axes whose switch was found, to be located by a report
        self._unlock = False
        self._deaf = False  # after an alarm it may answer nothing but a reset

    def trust_count(self) -> None:
        """Take the controller's count for the position, where it lies within every range."""
        if not self._machine.position_lost:
            self.reports.trust_count(self._position)

    # --- how it stands -----------------------------------------------------------------------

    @property
    def stop_pending(self) -> bool:
        """Whether it must still come to rest and be emptied after a stop."""
        return bool(self._stops) or self._braking or self._reset_s is not None

    @property
    def state(self) -> DeviceState:
        """The state of the controller."""
        if self.fault is not None:
            return DeviceState.FAULT
        if self._searches or self._homed:
            return DeviceState.HOMING
        if self._targets or self._machine.moving:
            return DeviceState.MOVING
        return DeviceState.IDLE

    @property
    def silent_s(self) -> float:
        """For how long it has said nothing that could be used; 0 for a short while."""
        if self._may_be_silent():
            return 0.0
        heard_s = min(self.dialogue.heard_s, self._used_s)
        silent_s = self._clock() - heard_s
        return silent_s if silent_s > self._patience(_SILENT_S) else 0.0

    @property
    def braking(self) -> bool:
        """Whether axes may still brake."""
        return self._braking or self._machine.moving

    @property
    def is_beyond_reach(self) -> bool:
        """Whether nothing more can be done to it: its line is lost, or an alarm has locked it."""
        return self._lost is not None or self._deaf

    @property
    def is_homing(self) -> bool:
        """Whether it searches for switches."""
        return bool(self._searches)

    @property
    def ready(self) -> bool:
        """Whether it takes a line."""
        return (
            self.dialogue.awaited is None
            and not self._stops
            and not self._braking
            and self._reset_s is None
            and self.fault is None
        )

    # --- what is asked of it -----------------------------------------------------------------

    def move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        """Begin to move axes, m or rad, no faster than ``speeds``; a move under way is changed."""
        targets = {**self._targets, **targets}
        speeds = {**{k: v for k, v in self._speeds.items() if k not in targets}, **speeds}
        under_way = self._move is not None
        move = None
        if not under_way and self.ready and not self.reports.is_in_doubt:
            move = self._move_to(targets, speeds)
            if move is None:
                return
        with permit.passing():
            if move is not None:
                line = move.line(self._position, on_trial=self.reports.untried)
                assert line is not None, "of a move that begins nothing has been sent"
                self.dialogue.say(line)
            elif under_way:  # it brakes and forgets; then the new move begins
                self.dialogue.send_realtime(JOG_CANCEL)
                self._expect_braking()
        self._targets, self._speeds, self._permit, self._move = targets, speeds, permit, move

    def stop(self) -> None:
        """Halt all axes; any thread."""
        # A controller that homes hears no feed hold, but a reset; its position is unknown anyway.
        data = RESET if self._searches else HALT
        self._stops.append(data)
        with suppress(ConnectionLostError):  # the next step says so
            self.dialogue.send_realtime(data)

    def clear_fault(self, permit: Permit) -> None:
        """Reset it, and forget the fault."""
        with permit.passing():
            self.dialogue.send_realtime(RESET)
        self._begin_reset()
        self.dialogue.resume_after_pause()
        self._used_s = self._clock()
        self.fault = None
        self._deaf = False
        # Without switches nothing else ends the lock of an alarm; the position stays unknown.
        self._unlock = not self._settings.can_home

    def home(self, lines: deque[tuple[str, tuple[str, ...]]], permit: Permit) -> None:
        """Search for switches: each line with the axes that it is for."""
        with permit.passing():
            self._searches = lines  # before the line goes: a stop that follows must reset
            self.reports.forget(axis for _, axes in lines for axis in axes)
            self.dialogue.say(lines[0][0])
        self._permit = permit

    def step(self, now_s: float) -> Samples:
        """Process its output, send what comes next, and return its new samples.

        Raises
        ------
        ConnectionLostError
            If it has said nothing for too long.
        """
        if self._lost is not None:
            raise ConnectionLostError(self._lost)
        self._notice_pause(now_s)
        self._follow_stops()
        self.dialogue.may_be_silent = self._may_be_silent()
        for reception in self.dialogue.received():
            self._take(reception)
        self._empty_at_rest()
        self._go_on()
        self._look_at_times(now_s)
        self.dialogue.ask(self._poll_s, self._asked_s)
        asked_s = self.dialogue.asked_s
        self._asked_s = asked_s if asked_s is not None else self._asked_s
        return self._samples()

    # --- what is heard -----------------------------------------------------------------------

    def _take(self, reception: Reception) -> None:
        heard = reception.message
        if isinstance(heard, Status):
            self._take_status(heard, reception)
        elif isinstance(heard, Answer):
            self._answered(heard)
        elif isinstance(heard, Alarm):
            self._alarmed(heard)
        elif isinstance(heard, Welcome):
            self._welcomed()

    def _take_status(self, status: Status, reception: Reception) -> None:
        if not self.reports.is_usable(status, reception):
            self.dialogue.count_discarded()
            if self.reports.shows_new_position:
                self.reports.expect_anywhere()
                self.reports.forget(self.reports.names)
                self._give_up(
                    message(
                        "engine",
                        "{count} reports in a row put the axes where they cannot have gone by "
                        "themselves; the position is unknown, home all axes",
                    ).fill(count=REPORTS_OF_A_NEW_POSITION)
                )
            return
        assert status.position is not None, "it is usable"
        self._used_s = reception.received_s
        self._deaf = False
        if reception.time_s is not None:
            self._rows.append((reception.time_s - self._opened_s, status.position))
        if not reception.fresh:
            return
        machine = interpret_state(status)
        if not machine.recognized:
            # Nobody knows whether such a state moves: the count tells.
            machine = MachineState(status.position != self._position, machine.fault)
        rests = not machine.moving and status.position == self._position
        self._position, self._machine = status.position, machine
        self._hold_again()
        if self._homed and rests:
            self._locate_homed_axes(reception.asked_s)
        self._heed_state()
        self._arrive()

    def _heed_state(self) -> None:
        """Lock motion where the controller itself forbids it."""
        machine = self._machine
        expected = self._braking or self._stops or self._reset_s is not None
        locked_already = machine.position_lost and not self.reports.known and self._move is None
        if machine.position_lost:
            self.reports.forget(self.reports.names)
        if machine.fault is None or self.fault is not None or self._searches:
            return
        if (expected and machine.holds) or (machine.alarm and locked_already):
            return
        _LOG.warning("%s: %s", self._name, machine.fault)
        self._end_move()
        self.fault = machine.fault

    def _locate_homed_axes(self, taken_s: float) -> None:
        """Find out where homed axes are. Two reports in a row agree on it, so it is no slip."""
        homed, self._homed = self._homed, set()
        try:
            self.reports.locate(homed, self._position, taken_s)
        except InputError as error:
            _LOG.warning("%s: %s", self._name, error)
            self._end_move()
            self.fault = str(error)

    def _arrive(self) -> None:
        """End a move whose end has been reached, and one that goes elsewhere."""
        move = self._move
        if move is None:
            return
        if strayed := move.strayed(self._position):
            self.reports.forget(axis.name for axis in move.axes)
            self._give_up(strayed)
            return
        self.reports.confirm_direction(move.passed_trial(self._position))
        if self._machine.moving or self.dialogue.awaited is not None or self._braking:
            return
        untried = [axis.name for axis in move.axes if axis.name in self.reports.untried]
        if not move.fully_sent and not untried:
            return
        if short := move.missed(self._position):
            self._give_up(
                message("engine", "the move ended before its target: {short}").fill(short=short)
            )
        else:
            self._end_move()

    def _answered(self, answer: Answer) -> None:
        line, self.dialogue.awaited = self.dialogue.awaited, None
        self._hold_again()
        if line is None:
            return
        if answer.error is not None:
            self._give_up(
                message("engine", "the controller refused {line}: {text}").fill(
                    line=repr(line), text=describe_error(answer.error, self._settings.firmware)
                ),
            )
        elif self._searches and line == self._searches[0][0]:
            self._homed |= set(self._searches.popleft()[1])
            # Some answer no query while they home, and then the last one at an unknown time.
            self.dialogue.abandon_query()
            self.reports.expect_anywhere()
            self._used_s = self._clock()

    def _alarmed(self, alarm: Alarm) -> None:
        self.dialogue.forget()
        self._machine = MachineState()
        self._braking = False
        self._end_move()
        self._searches.clear()
        self._homed.clear()
        self.reports.forget(self.reports.names)
        self._deaf = True
        # A homing that is stopped ends with an alarm of its own.
        if alarm.number != _HOMING_RESET_ALARM or not self.stop_pending:
            self.fault = describe_alarm(alarm.number, self._settings.firmware)
            _LOG.warning("%s: %s", self._name, self.fault)

    def _welcomed(self) -> None:
        if self._reset_s is None and not self._stops and self.fault is None:
            self.reports.forget(self.reports.names)
            self.fault = message(
                "engine",
                "the controller was reset from outside, or lost its supply; clear the fault, "
                "then home",
            )
        self._deaf = False
        self._reset_s = None
        self._searches.clear()
        self._homed.clear()
        self._end_move(keep=self._reset_wanted())
        self.dialogue.forget()

    def _reset_wanted(self) -> bool:
        """Whether what is wanted was requested after the stop that led to the reset."""
        return self._permit is not None and self._permit.valid and self.fault is None

    # --- what is done ------------------------------------------------------------------------

    def _notice_pause(self, now_s: float) -> None:
        """Cancel everything after a pause of this program: nobody watched meanwhile."""
        paused_s, self._stepped_s = now_s - self._stepped_s, now_s
        if paused_s <= MAX_PAUSE_S:
            return
        self.dialogue.resume_after_pause()
        self._used_s = now_s
        if self._move is None and not self._targets and not self._searches:
            return
        _LOG.warning(
            "%s: this program was suspended for %.1f s; the motion is cancelled",
            self._name,
            paused_s,
        )
        self._permit = None
        self.stop()

    def _follow_stops(self) -> None:
        """Note what other threads have told the controller, and let nothing continue."""
        while self._stops:
            if self._stops.popleft() == RESET:
                self._searches.clear()
                self._begin_reset()
            else:
                self._braking = True
                self._expect_braking()
            self._end_move(keep=self._reset_wanted() and self._move is None)

    def _hold_again(self) -> None:
        """Repeat a halt for as long as axes move: a line that it overtook begins a new jog."""
        if self._braking and self._machine.moving:
            self.dialogue.send_realtime(HALT)
            self._expect_braking()

    def _empty_at_rest(self) -> None:
        if self._braking and not self._machine.moving and self._reset_s is None:
            self.dialogue.send_realtime(RESET)
            self._begin_reset()

    def _expect_braking(self) -> None:
        """Take it to brake until a report that was requested from now on says otherwise."""
        self.dialogue.invalidate_reports()
        self._machine = MachineState(moving=True)

    def _begin_reset(self) -> None:
        self._reset_s = self._clock()
        self._braking = False  # a hold that comes after this byte wants a reset of its own
        self.dialogue.forget()

    def _go_on(self) -> None:
        """Say what comes next: a search, a piece of a move, a move that had to wait."""
        if not self.ready:
            return
        if self._unlock:
            self._unlock = False
            self.dialogue.say("$X")
        if self._permit is None or self.dialogue.awaited is not None:
            return
        try:
            if self._searches:
                with self._permit.passing(begins=False):
                    self.dialogue.say(self._searches[0][0])
            elif self._targets:
                self._say_next(self._permit)
        except GateError as error:
            _LOG.info("%s: %s", self._name, error)
            self._searches.clear()
            self._end_move()

    def _say_next(self, permit: Permit) -> None:
        begins = self._move is None
        if self._move is None:
            # It still brakes, or nobody knows where it is: the move waits.
            if self._machine.moving or self.reports.is_in_doubt:
                return
            self._move = self._move_to(self._targets, self._speeds)
            if self._move is None:
                self._end_move()
                return
        line = self._move.line(self._position, on_trial=self.reports.untried)
        if line is not None:
            with permit.passing(begins=begins):
                self.dialogue.say(line)

    def _move_to(
        self, targets: Mapping[str, float], speeds: Mapping[str, float]
    ) -> StraightMove | None:
        return StraightMove.of(
            self.reports.axes, self._position, targets, speeds, self.dialogue.round_trip_s
        )

    def _may_be_silent(self) -> bool:
        """Whether it answers no questions now: while it homes, and after an alarm."""
        return bool(self._searches) or self._deaf

    def _end_move(self, *, keep: bool = False) -> None:
        self._move = None
        if not keep:
            self._targets, self._speeds = {}, {}

    def _give_up(self, fault: str) -> None:
        """Halt and say why."""
        _LOG.warning("%s: %s", self._name, fault)
        self._searches.clear()
        self._end_move()
        self.fault = fault
        self.dialogue.send_realtime(HALT)
        self._braking = True
        self._expect_braking()

    def _patience(self, seconds: float) -> float:
        """Return a time that a fast line needs, for this one."""
        return seconds + _WAITING_ROUND_TRIPS * self.dialogue.round_trip_s

    def _look_at_times(self, now_s: float) -> None:
        if self._reset_s is not None and now_s - self._reset_s > self._patience(_RESET_S):
            self.dialogue.send_realtime(RESET)
            self._reset_s = now_s
        limit_s = self._homing_s if self._searches else self._patience(_LINE_S)
        line, since_s = self.dialogue.awaited, self.dialogue.awaited_since_s
        silent_s = now_s - self.dialogue.heard_s
        if line is not None and now_s - since_s > limit_s:
            self.dialogue.forget()
            if silent_s < self._patience(_SILENT_S) or self._searches:
                self._give_up(
                    message("engine", "no answer to {line} within {limit_s} s").fill(
                        line=repr(line), limit_s=rounded(limit_s, 2)
                    ),
                )
        if self._may_be_silent():
            return
        lost_s = self._patience(_LOST_S)
        if silent_s > lost_s:
            self._lost = message(
                "engine",
                "{port}: the controller has not answered for {seconds} s; it ends its "
                "motion within half a second plus braking. Check the machine, then "
                "reconnect",
            ).fill(port=self._port, seconds=rounded(lost_s, 2))
            raise ConnectionLostError(self._lost)
        if now_s - self._used_s > lost_s and self.fault is None:
            self.reports.forget(self.reports.names)
            self._give_up(
                message(
                    "engine",
                    "no report of the last {seconds} s could be used; check the cable, then clear "
                    "the fault and home",
                ).fill(seconds=rounded(lost_s, 2))
            )

    def _samples(self) -> Samples:
        rows, self._rows = self._rows, []
        if not rows:
            return Samples.none(len(self.reports.axes))
        position = np.array([self.reports.values(at) for _, at in rows])
        none = np.full(position.shape, np.nan)
        time_s = np.array([time_s for time_s, _ in rows])
        return Samples(time_s, position, position, none, np.full(len(rows), -1))
