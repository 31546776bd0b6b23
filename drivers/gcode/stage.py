"""The driver of a stage that a GRBL controller moves by G-code."""

import logging
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from types import MappingProxyType
from typing import ClassVar

import numpy as np

from rotemina.drivers.abilities import Homer, Linked
from rotemina.drivers.axes import AxisDescription
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import ConnectionLostError, DriverError, LimitError, StateError
from rotemina.drivers.gate import GateError, Permit
from rotemina.drivers.gcode.coordinates import StageAxis, check_stage
from rotemina.drivers.gcode.dialogue import HOLD, JOG_CANCEL, RESET, UNCERTAIN_S, Dialogue
from rotemina.drivers.gcode.opening import Opening
from rotemina.drivers.gcode.reports import (
    CRITICAL,
    POSITION_KEPT,
    Alarm,
    Answer,
    Message,
    Status,
    Welcome,
)
from rotemina.drivers.gcode.straight_move import StraightMove
from rotemina.drivers.link import LinkQuality
from rotemina.drivers.mc68hc11.port import OpenPort, Port, open_port
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.errors import InputError
from rotemina.sim.messages import marked, message
from rotemina.sim.robot.model import Robot

_LOG = logging.getLogger(__name__)
_SILENT_S, _LOST_S = 0.25, 2.0
_LINE_S = 1.0  # for an answer to a jog: it is given when the line is in the queue
_RESET_S = 1.0
_SINGLE = "H"  # of the controller's options: it homes axes one by one


class GcodeStage(Homer, Linked):
    """A stage of up to six stepping motors behind a GRBL controller.

    Settings: ``port``, a device or a URL of pyserial; ``baud``; ``letters`` of the axes, in the
    order of the robot file; ``poll_s``, how often a report is asked for; ``homing_s``, how long a
    search for switches may take; ``trust_position``, take the controller's count of steps for the
    position when it is opened (otherwise the axes must be homed first).

    The controller has no sensors: readings are its own count of steps. Nor has it a clock: a sample
    is of when it was asked for, and is left out where the answer was late.

    Parameters
    ----------
    robot, settings, clock
        See :class:`rotemina.drivers.driver.Driver`.
    open_port : callable
        Return an open port of a URL and a baud rate.
    pause : callable
        Let some seconds pass, while the controller is opened or closed.

    Raises
    ------
    InputError
        If the robot has an axis that such a controller cannot move.
    """

    name = "gcode"
    service_period_s = 0.005
    stamp_error_s = UNCERTAIN_S
    default_settings: ClassVar[Mapping[str, SettingValue]] = MappingProxyType(
        {
            "port": "",
            "baud": 115_200,
            "letters": "XYZABC",
            "poll_s": 0.02,
            "homing_s": 120.0,
            "trust_position": False,
        }
    )

    def __init__(
        self,
        robot: Robot,
        settings: Mapping[str, object] | None = None,
        *,
        clock: Clock = time.monotonic,
        open_port: OpenPort = open_port,
        pause: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__(robot, settings, clock=clock)
        self._letters = str(self.settings["letters"])
        if set(self._letters) - set("XYZABCUVW") or len(set(self._letters)) < len(self._letters):
            raise SettingError(
                message(
                    "engine", "gcode: letters = {letters}: must be different ones of XYZABCUVW"
                ).fill(letters=repr(self._letters))
            )
        check_stage(robot, self._letters)
        self._baud = int(self._bounded("baud", 300, 4_000_000))
        self._poll_s = self._bounded("poll_s", 0.01, 0.2)
        self._homing_s = self._bounded("homing_s", 1.0, 3600.0)
        self._open_port = open_port
        self._pause = pause
        self._dialogue: Dialogue | None = None
        self._port: Port | None = None
        self._opened_s = 0.0
        self._axes: tuple[StageAxis, ...] = ()
        self._forget()

    def _forget(self) -> None:
        """Begin anew: nothing is under way, nothing is known."""
        self._known: set[str] = set()
        self._single = self._able = False
        self._fault: str | None = None
        self._lost: str | None = None
        self._latest = Status("Idle", 0, None)
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

    # --- what the contract asks for ----------------------------------------------------------

    @property
    def descriptions(self) -> tuple[AxisDescription, ...]:
        """The axes, with the steps that the controller tells."""
        told = super().descriptions
        if not self._axes:
            return told
        return tuple(
            AxisDescription(
                one.name, one.kind, one.role, one.low, one.high, one.unit, axis.resolution
            )
            for one, axis in zip(told, self._axes, strict=True)
        )

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """All axes, where the controller's homing is enabled ($22)."""
        return self.axes if self._able else ()

    @property
    def stop_pending(self) -> bool:
        """Whether the controller has yet to come to rest and to be emptied after a stop."""
        return self._is_open and (bool(self._stops) or self._braking or self._reset_s is not None)

    def link_quality(self) -> LinkQuality:
        """Return how well the line does."""
        return LinkQuality() if self._dialogue is None else self._dialogue.quality()

    def _open(self) -> None:
        url = str(self.settings["port"])
        port = self._open_port(url, self._baud)
        try:
            self._forget()
            dialogue = Dialogue(port, self.clock, self._baud)
            info = Opening(dialogue, self.clock, self._pause, url).handshake()
            assert info.status.position is not None, "the opening refuses one without"
            self._axes = self._matched(info.settings, len(info.status.position), url)
            self._able, self._single = bool(info.settings.get(22)), _SINGLE in info.options
        except BaseException:
            port.close()
            raise
        self._dialogue, self._port, self._opened_s = dialogue, port, self.clock()
        self._latest = info.status
        if self.settings["trust_position"] and info.status.state == "Idle":
            self._known = set(self.axes)

    def _matched(
        self, settings: Mapping[int, float], count: int, url: str
    ) -> tuple[StageAxis, ...]:
        if count < len(self.axes):
            raise DriverError(
                message(
                    "engine",
                    "{url}: the controller has {count} axes, robot {robot} {wanted}; take the "
                    "robot file of this stage",
                ).fill(url=url, count=count, robot=repr(self.robot.name), wanted=len(self.axes))
            )
        try:
            return tuple(
                StageAxis.of(self.robot, name, self._letters[number], number, settings)
                for number, name in enumerate(self.axes)
            )
        except InputError as error:
            raise DriverError(
                message("engine", "{url}: {error}").fill(url=url, error=str(error))
            ) from error

    def _close(self) -> None:
        dialogue, self._dialogue = self._dialogue, None
        assert dialogue is not None, "an open driver has one"
        try:
            if self._lost is None and (self._latest.moving or self._way or self._searching):
                dialogue.forget()
                Opening(dialogue, self.clock, self._pause, str(self.settings["port"])).empty()
        finally:
            if self._port is not None:
                self._port.close()

    def _status(self) -> DeviceStatus:
        unhomed = tuple(axis for axis in self.axes if axis not in self._known)
        silent_s = 0.0
        if self._dialogue is not None and not self._may_be_silent():
            silent_s = self.clock() - self._dialogue.heard_s
        return DeviceStatus(
            self._state(),
            fault=self._fault,
            position_known=not unhomed,
            unhomed=unhomed,
            silent_s=silent_s if silent_s > _SILENT_S else 0.0,
        )

    def _state(self) -> DeviceState:
        if self._fault is not None:
            return DeviceState.FAULT
        if self._searching:
            return DeviceState.HOMING
        if self._wanted or self._latest.moving:
            return DeviceState.MOVING
        return DeviceState.IDLE

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        dialogue = self._talk()
        wanted = {**self._wanted, **targets}
        speeds = {**{k: v for k, v in self._speeds.items() if k not in targets}, **speeds}
        under_way = self._way is not None
        way = None
        if not under_way and self._ready(dialogue):
            way = self._way_to(wanted, speeds)
            if way is None:
                return
        with permit.passing():
            if way is not None:
                dialogue.say(self._next(way))
            elif under_way:
                dialogue.send_realtime(JOG_CANCEL)  # it brakes and forgets; then the new way begins
                self._brakes(dialogue, "Jog")
        self._wanted, self._speeds, self._permit, self._way = wanted, speeds, permit, way

    def _stop(self) -> None:
        # A controller that homes hears no feed hold, but a reset; its position is unknown anyway.
        byte = RESET if self._searching else HOLD
        self._stops.append(byte)
        dialogue = self._dialogue
        if dialogue is not None:
            with suppress(ConnectionLostError):  # the next read says so
                dialogue.send_realtime(byte)

    def _clear_fault(self, permit: Permit) -> None:
        dialogue = self._talk()
        if self._braking or self._latest.moving:
            raise StateError(
                message(
                    "engine", "{name}: its axes still brake; clear the fault when they rest"
                ).fill(name=self.name)
            )
        with permit.passing():
            dialogue.send_realtime(RESET)
        self._begin_reset(dialogue)
        self._fault = None
        self._deaf = False

    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        dialogue = self._talk()
        if not self._single and set(axes) != set(self.axes):
            raise LimitError(
                message(
                    "engine",
                    "{name}: this controller homes all axes together; home all {count}, or build "
                    "it with single-axis homing",
                ).fill(name=self.name, count=len(self.axes))
            )
        if not self._ready(dialogue):
            raise StateError(
                message("engine", "{name}: it is still busy with a stop; ask again").fill(
                    name=self.name
                )
            )
        lines = deque([("$H", self.axes)])
        if self._single:
            lines = deque(("$H" + self._letters[self.axes.index(axis)], (axis,)) for axis in axes)
        with permit.passing():
            self._searching = lines  # before the line goes: a stop that follows must reset
            self._known -= set(axes)
            dialogue.say(lines[0][0])
        self._permit = permit

    def _read(self) -> Samples:
        now_s = self.clock()
        dialogue = self._talk()
        if self._lost is not None:
            raise ConnectionLostError(self._lost)
        self._follow_stops(dialogue)
        for told, asked_s, fresh in dialogue.hear():
            self._take(dialogue, told, asked_s, fresh)
        self._empty_at_rest(dialogue)
        self._go_on(dialogue)
        self._look_at_times(dialogue, now_s)
        dialogue.ask(self._poll_s, self._asked_s)
        self._asked_s = dialogue.asked_s if dialogue.asked_s is not None else self._asked_s
        return self._samples()

    # --- what is heard -----------------------------------------------------------------------

    def _take(
        self, dialogue: Dialogue, message: Message, asked_s: float | None, fresh: bool
    ) -> None:
        if isinstance(message, Status):
            if message.position is None:
                return
            if asked_s is not None:
                self._rows.append((asked_s - self._opened_s, message.position))
            if fresh:
                self._latest = message
                self._arrive(dialogue)
        elif isinstance(message, Answer):
            self._answered(dialogue, message)
        elif isinstance(message, Alarm):
            self._alarmed(dialogue, message)
        elif isinstance(message, Welcome):
            self._welcomed(dialogue)

    def _arrive(self, dialogue: Dialogue) -> None:
        """End a way whose end has been reached."""
        if self._latest.moving or dialogue.awaited is not None or self._braking:
            return
        way, position = self._way, self._latest.position
        if way is None or position is None or not way.fully_sent:
            return
        if short := way.missed(position):
            self._give_up(
                dialogue,
                message("engine", "it came to rest before its end: {short}").fill(short=short),
            )
        else:
            self._end_way()

    def _answered(self, dialogue: Dialogue, answer: Answer) -> None:
        line, dialogue.awaited = dialogue.awaited, None
        if line is None:
            return
        if answer.error is not None:
            self._give_up(
                dialogue,
                message("engine", "the controller refused {line}: {text}").fill(
                    line=repr(line), text=answer.text
                ),
            )
        elif self._searching and line == self._searching[0][0]:
            self._known |= set(self._searching.popleft()[1])

    def _alarmed(self, dialogue: Dialogue, alarm: Alarm) -> None:
        dialogue.forget()
        self._latest = Status("Alarm", 0, self._latest.position)
        self._braking = False
        self._end_way()
        self._searching.clear()
        if alarm.number not in POSITION_KEPT:
            self._known.clear()
        self._unlock = alarm.number in POSITION_KEPT
        self._deaf = alarm.number in CRITICAL
        if alarm.number != 6 or not self.stop_pending:  # 6 is how a homing ends that is stopped
            self._fault = alarm.text
            _LOG.warning("%s: %s", self.name, alarm.text)

    def _welcomed(self, dialogue: Dialogue) -> None:
        if self._reset_s is None and not self._stops and self._fault is None:
            self._known.clear()
            self._fault = marked(
                "engine", "the controller was reset by somebody else, or lost its supply"
            )
        self._deaf = False
        self._reset_s = None
        self._searching.clear()
        self._end_way(keep=self._reset_wanted())
        dialogue.forget()

    def _reset_wanted(self) -> bool:
        """Whether what is wanted was asked for after the stop that led to the reset."""
        return self._permit is not None and self._permit.valid and self._fault is None

    # --- what is done ------------------------------------------------------------------------

    def _follow_stops(self, dialogue: Dialogue) -> None:
        """Note what other threads have told the controller, and let nothing go on."""
        while self._stops:
            byte = self._stops.popleft()
            if byte == RESET:
                self._searching.clear()
                self._begin_reset(dialogue)
            else:
                self._braking = True
                self._brakes(dialogue, "Hold")
            self._end_way(keep=self._reset_wanted() and self._way is None)

    def _empty_at_rest(self, dialogue: Dialogue) -> None:
        if self._braking and not self._latest.moving and self._reset_s is None:
            dialogue.send_realtime(RESET)
            self._begin_reset(dialogue)

    def _brakes(self, dialogue: Dialogue, state: str) -> None:
        """Take it to brake until a report that was asked for from now on says otherwise."""
        dialogue.invalidate_reports()
        self._latest = Status(state, 1, self._latest.position)

    def _begin_reset(self, dialogue: Dialogue) -> None:
        self._reset_s = self.clock()
        self._braking = False  # a hold that comes after this byte wants a reset of its own
        dialogue.forget()

    def _go_on(self, dialogue: Dialogue) -> None:
        """Say what comes next: a search, a piece of a way, a way that had to wait."""
        if not self._ready(dialogue):
            return
        if self._unlock and self._latest.state == "Alarm":
            self._unlock = False
            dialogue.say("$X")
        if self._permit is None or dialogue.awaited is not None:
            return
        try:
            if self._searching:
                with self._permit.passing(begins=False):
                    dialogue.say(self._searching[0][0])
            elif self._wanted:
                self._say_next(dialogue, self._permit)
        except GateError as error:
            _LOG.info("%s: %s", self.name, error)
            self._searching.clear()
            self._end_way()

    def _say_next(self, dialogue: Dialogue, permit: Permit) -> None:
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
                dialogue.say(line)

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

    def _ready(self, dialogue: Dialogue) -> bool:
        """Whether the controller takes a line."""
        return (
            dialogue.awaited is None
            and not self._stops
            and not self._braking
            and self._reset_s is None
            and self._fault is None
        )

    def _end_way(self, *, keep: bool = False) -> None:
        self._way = None
        if not keep:
            self._wanted, self._speeds = {}, {}

    def _give_up(self, dialogue: Dialogue, fault: str) -> None:
        """Halt and say why."""
        _LOG.warning("%s: %s", self.name, fault)
        self._searching.clear()
        self._end_way()
        self._fault = fault
        dialogue.send_realtime(HOLD)
        self._braking = True
        self._brakes(dialogue, "Hold")

    def _look_at_times(self, dialogue: Dialogue, now_s: float) -> None:
        if self._reset_s is not None and now_s - self._reset_s > _RESET_S:
            dialogue.send_realtime(RESET)
            self._reset_s = now_s
        limit_s = self._homing_s if self._searching else _LINE_S
        if dialogue.awaited is not None and now_s - dialogue.awaited_since_s > limit_s:
            line = dialogue.awaited
            dialogue.forget()
            if now_s - dialogue.heard_s < _SILENT_S or self._searching:
                self._give_up(
                    dialogue,
                    message("engine", "no answer to {line} within {limit_s} s").fill(
                        line=repr(line), limit_s=limit_s
                    ),
                )
        if not self._may_be_silent() and now_s - dialogue.heard_s > _LOST_S:
            self._lost = message(
                "engine",
                "{port}: the controller has not answered for {seconds} s; it ends its "
                "motion within half a second plus braking. Check the machine, then "
                "reconnect",
            ).fill(port=str(self.settings["port"]), seconds=_LOST_S)
            raise ConnectionLostError(self._lost)

    def _samples(self) -> Samples:
        rows, self._rows = self._rows, []
        if not rows:
            return Samples.none(len(self.axes))
        position = np.array(
            [[axis.value(at[axis.number]) for axis in self._axes] for _, at in rows]
        )
        none = np.full(position.shape, np.nan)
        time_s = np.array([time_s for time_s, _ in rows])
        return Samples(time_s, position, position, none, np.full(len(rows), -1))

    def _talk(self) -> Dialogue:
        assert self._dialogue is not None, "the contract calls hooks of an open driver"
        return self._dialogue

    def _bounded(self, name: str, low: float, high: float) -> float:
        value = float(self.settings[name])
        if not low <= value <= high:
            raise SettingError(
                message("engine", "gcode: {name} = {value}: must be {low} to {high}").fill(
                    name=name, value=value, low=low, high=high
                )
            )
        return value
