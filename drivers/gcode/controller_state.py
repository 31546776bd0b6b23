"""The state of a GRBL controller, and what to send it next.

An alarm is a fault, which ``clear_fault`` resets; until then a controller that a switch has locked
does not answer, but its line is not lost. A stop resets it only after the axes have come to rest,
because a reset in motion loses steps; the reset empties the queue, so that no ``~`` resumes it.
"""

import logging
from collections import deque
from collections.abc import Mapping
from contextlib import suppress

import numpy as np

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.gate import GateError, Permit
from rotemina.drivers.gcode.coordinates import StageAxis
from rotemina.drivers.gcode.dialogue import HOLD, JOG_CANCEL, RESET, Dialogue
from rotemina.drivers.gcode.grbl_reports import (
    CRITICAL,
    POSITION_KEPT,
    Alarm,
    Answer,
    Message,
    Status,
    Welcome,
)
from rotemina.drivers.gcode.straight_move import StraightMove
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.messages import marked, message

_LOG = logging.getLogger(__name__)
_SILENT_S, _LOST_S = 0.25, 2.0
_LINE_S = 1.0  # for an answer to a jog: it is given when the line is in the queue
_RESET_S = 1.0


class Controller:
    """One controller that was opened; what it does is followed in steps.

    Any thread may call :meth:`stop`; all else is the driver's own thread's.

    Parameters
    ----------
    name : str
        The driver's, for the log.
    dialogue : Dialogue
    axes : tuple of StageAxis
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
        status: Status,
        clock: Clock,
        *,
        poll_s: float,
        homing_s: float,
        port: str,
    ) -> None:
        self.dialogue = dialogue
        self.known: set[str] = set()  # axes whose position is
        self.fault: str | None = None
        self._name, self._axes, self._clock, self._port = name, axes, clock, port
        self._poll_s, self._homing_s = poll_s, homing_s
        self._opened_s = clock()
        self._lost: str | None = None
        self._latest = status
        self._asked_s = float("-inf")
        self._rows: list[tuple[float, tuple[float, ...]]] = []
        # Written by whichever thread stops, compared by the driver's own.
        self._stops: deque[bytes] = deque()
        self._braking = False  # told to halt: a reset follows once the axes rest
        self._reset_s: float | None = None  # since when a reset is to be confirmed
        self._wanted: dict[str, float] = {}
        self._speeds: dict[str, float] = {}
        self._permit: Permit | None = None
        self._way: StraightMove | None = None
        self._searching: deque[tuple[str, tuple[str, ...]]] = deque()  # line, axes; first: now
        self._unlock = False
        self._deaf = False  # after a critical alarm it answers nothing but a reset

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
        if self._searching:
            return DeviceState.HOMING
        if self._wanted or self._latest.moving:
            return DeviceState.MOVING
        return DeviceState.IDLE

    @property
    def silent_s(self) -> float:
        """For how long it has said nothing, where it should have; 0 for a short while."""
        silent_s = 0.0 if self._may_be_silent() else self._clock() - self.dialogue.heard_s
        return silent_s if silent_s > _SILENT_S else 0.0

    @property
    def braking(self) -> bool:
        """Whether axes may still brake."""
        return self._braking or self._latest.moving

    @property
    def to_be_emptied(self) -> bool:
        """Whether it holds anything that would continue after it is left."""
        return self._lost is None and bool(self._latest.moving or self._way or self._searching)

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
        wanted = {**self._wanted, **targets}
        speeds = {**{k: v for k, v in self._speeds.items() if k not in targets}, **speeds}
        under_way = self._way is not None
        way = None
        if not under_way and self.ready:
            way = self._way_to(wanted, speeds)
            if way is None:
                return
        with permit.passing():
            if way is not None:
                self.dialogue.say(self._next(way))
            elif under_way:  # it brakes and forgets; then the new way begins
                self.dialogue.send_realtime(JOG_CANCEL)
                self._brakes("Jog")
        self._wanted, self._speeds, self._permit, self._way = wanted, speeds, permit, way

    def stop(self) -> None:
        """Halt all axes; any thread."""
        # A controller that homes hears no feed hold, but a reset; its position is unknown anyway.
        byte = RESET if self._searching else HOLD
        self._stops.append(byte)
        with suppress(ConnectionLostError):  # the next step says so
            self.dialogue.send_realtime(byte)

    def clear_fault(self, permit: Permit) -> None:
        """Reset it, and forget the fault."""
        with permit.passing():
            self.dialogue.send_realtime(RESET)
        self._begin_reset()
        self.fault = None
        self._deaf = False

    def home(self, lines: deque[tuple[str, tuple[str, ...]]], permit: Permit) -> None:
        """Search for switches: each line with the axes that it is for."""
        with permit.passing():
            self._searching = lines  # before the line goes: a stop that follows must reset
            self.known -= {axis for _, axes in lines for axis in axes}
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
        self._follow_stops()
        for told, asked_s, fresh in self.dialogue.received():
            self._take(told, asked_s, fresh)
        self._empty_at_rest()
        self._go_on()
        self._look_at_times(now_s)
        self.dialogue.ask(self._poll_s, self._asked_s)
        asked_s = self.dialogue.asked_s
        self._asked_s = asked_s if asked_s is not None else self._asked_s
        return self._samples()

    # --- what is heard -----------------------------------------------------------------------

    def _take(self, message: Message, asked_s: float | None, fresh: bool) -> None:
        if isinstance(message, Status):
            if message.position is None:
                return
            if asked_s is not None:
                self._rows.append((asked_s - self._opened_s, message.position))
            if fresh:
                self._latest = message
                self._arrive()
        elif isinstance(message, Answer):
            self._answered(message)
        elif isinstance(message, Alarm):
            self._alarmed(message)
        elif isinstance(message, Welcome):
            self._welcomed()

    def _arrive(self) -> None:
        """End a way whose end has been reached."""
        if self._latest.moving or self.dialogue.awaited is not None or self._braking:
            return
        way, position = self._way, self._latest.position
        if way is None or position is None or not way.fully_sent:
            return
        if short := way.missed(position):
            self._give_up(
                message("engine", "the move ended before its target: {short}").fill(short=short)
            )
        else:
            self._end_way()

    def _answered(self, answer: Answer) -> None:
        line, self.dialogue.awaited = self.dialogue.awaited, None
        if line is None:
            return
        if answer.error is not None:
            self._give_up(
                message("engine", "the controller refused {line}: {text}").fill(
                    line=repr(line), text=answer.text
                ),
            )
        elif self._searching and line == self._searching[0][0]:
            self.known |= set(self._searching.popleft()[1])

    def _alarmed(self, alarm: Alarm) -> None:
        self.dialogue.forget()
        self._latest = Status("Alarm", 0, self._latest.position)
        self._braking = False
        self._end_way()
        self._searching.clear()
        if alarm.number not in POSITION_KEPT:
            self.known.clear()
        self._unlock = alarm.number in POSITION_KEPT
        self._deaf = alarm.number in CRITICAL
        if alarm.number != 6 or not self.stop_pending:  # 6 is how a homing ends that is stopped
            self.fault = alarm.text
            _LOG.warning("%s: %s", self._name, alarm.text)

    def _welcomed(self) -> None:
        if self._reset_s is None and not self._stops and self.fault is None:
            self.known.clear()
            self.fault = marked(
                "engine", "the controller was reset from outside, or lost its supply"
            )
        self._deaf = False
        self._reset_s = None
        self._searching.clear()
        self._end_way(keep=self._reset_wanted())
        self.dialogue.forget()

    def _reset_wanted(self) -> bool:
        """Whether what is wanted was requested after the stop that led to the reset."""
        return self._permit is not None and self._permit.valid and self.fault is None

    # --- what is done ------------------------------------------------------------------------

    def _follow_stops(self) -> None:
        """Note what other threads have told the controller, and let nothing continue."""
        while self._stops:
            byte = self._stops.popleft()
            if byte == RESET:
                self._searching.clear()
                self._begin_reset()
            else:
                self._braking = True
                self._brakes("Hold")
            self._end_way(keep=self._reset_wanted() and self._way is None)

    def _empty_at_rest(self) -> None:
        if self._braking and not self._latest.moving and self._reset_s is None:
            self.dialogue.send_realtime(RESET)
            self._begin_reset()

    def _brakes(self, state: str) -> None:
        """Take it to brake until a report that was requested from now on says otherwise."""
        self.dialogue.invalidate_reports()
        self._latest = Status(state, 1, self._latest.position)

    def _begin_reset(self) -> None:
        self._reset_s = self._clock()
        self._braking = False  # a hold that comes after this byte wants a reset of its own
        self.dialogue.forget()

    def _go_on(self) -> None:
        """Say what comes next: a search, a piece of a way, a way that had to wait."""
        if not self.ready:
            return
        if self._unlock and self._latest.state == "Alarm":
            self._unlock = False
            self.dialogue.say("$X")
        if self._permit is None or self.dialogue.awaited is not None:
            return
        try:
            if self._searching:
                with self._permit.passing(begins=False):
                    self.dialogue.say(self._searching[0][0])
            elif self._wanted:
                self._say_next(self._permit)
        except GateError as error:
            _LOG.info("%s: %s", self._name, error)
            self._searching.clear()
            self._end_way()

    def _say_next(self, permit: Permit) -> None:
        begins = self._way is None
        if self._way is None:
            if self._latest.moving:
                return  # it still brakes
            self._way = self._way_to(self._wanted, self._speeds)
            if self._way is None:
                self._end_way()
                return
        assert self._latest.position is not None, "a controller that was opened tells one"
        line = self._way.line(self._latest.position)
        if line is not None:
            with permit.passing(begins=begins):
                self.dialogue.say(line)

    def _way_to(
        self, targets: Mapping[str, float], speeds: Mapping[str, float]
    ) -> StraightMove | None:
        assert self._latest.position is not None, "a controller that was opened tells one"
        return StraightMove.of(self._axes, self._latest.position, targets, speeds)

    def _next(self, way: StraightMove) -> str:
        assert self._latest.position is not None, "a controller that was opened tells one"
        line = way.line(self._latest.position)
        assert line is not None, "of a way that begins nothing has been told"
        return line

    def _may_be_silent(self) -> bool:
        """Whether it answers no questions now: while it homes, and after a critical alarm."""
        return bool(self._searching) or self._deaf

    def _end_way(self, *, keep: bool = False) -> None:
        self._way = None
        if not keep:
            self._wanted, self._speeds = {}, {}

    def _give_up(self, fault: str) -> None:
        """Halt and say why."""
        _LOG.warning("%s: %s", self._name, fault)
        self._searching.clear()
        self._end_way()
        self.fault = fault
        self.dialogue.send_realtime(HOLD)
        self._braking = True
        self._brakes("Hold")

    def _look_at_times(self, now_s: float) -> None:
        if self._reset_s is not None and now_s - self._reset_s > _RESET_S:
            self.dialogue.send_realtime(RESET)
            self._reset_s = now_s
        limit_s = self._homing_s if self._searching else _LINE_S
        if self.dialogue.awaited is not None and now_s - self.dialogue.awaited_since_s > limit_s:
            line = self.dialogue.awaited
            self.dialogue.forget()
            if now_s - self.dialogue.heard_s < _SILENT_S or self._searching:
                self._give_up(
                    message("engine", "no answer to {line} within {limit_s} s").fill(
                        line=repr(line), limit_s=limit_s
                    ),
                )
        if not self._may_be_silent() and now_s - self.dialogue.heard_s > _LOST_S:
            self._lost = message(
                "engine",
                "{port}: the controller has not answered for {seconds} s; it ends its "
                "motion within half a second plus braking. Check the machine, then "
                "reconnect",
            ).fill(port=self._port, seconds=_LOST_S)
            raise ConnectionLostError(self._lost)

    def _samples(self) -> Samples:
        rows, self._rows = self._rows, []
        if not rows:
            return Samples.none(len(self._axes))
        position = np.array(
            [[axis.value(at[axis.number]) for axis in self._axes] for _, at in rows]
        )
        none = np.full(position.shape, np.nan)
        time_s = np.array([time_s for time_s, _ in rows])
        return Samples(time_s, position, position, none, np.full(len(rows), -1))
