"""The driver's connection: opened, served, stopped, and what its state is."""

import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from itertools import count
from types import MappingProxyType
from typing import ClassVar

from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver, MachineKind
from rotemina.drivers.errors import ConnectionLostError, DriverError
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.mc68hc11.axes import board_axes
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.dialogue import Urgency
from rotemina.drivers.mc68hc11.driver_session import Session
from rotemina.drivers.mc68hc11.protocol_codes import VIRTUAL
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.drivers.serial_port import OpenPort, open_port
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.trajectory.speed_and_acceleration import SETPOINT_PERIOD_S

#: A longer pause of this program, s, ends what was under way: longer than those of a busy computer,
#: far shorter than the suspension of one, of which nobody knows what has changed meanwhile.
MAX_PAUSE_S = 1.0
_BUSY = (DeviceState.HOMING, DeviceState.PLAYING, DeviceState.MOVING)


class Connected(Driver):
    """A connection to the boards; see :class:`rotemina.drivers.mc68hc11.driver.MC68HC11`."""

    name = "mc68hc11"
    service_period_s = 0.001
    default_settings: ClassVar[Mapping[str, SettingValue]] = MappingProxyType(
        {
            "port": "",
            "second_port": "",
            "baud": 125_000,
            "settle_s": 0.5,
            "watchdog_s": 0.5,
            "latency_s": 0.015,
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
        self._open_port = open_port
        self._pause = pause
        self._baud = int(self._number("baud", 300, 4_000_000))
        self._settle_s = self._number("settle_s", 0.0, 60.0)
        self._watchdog_s = self._number("watchdog_s", 0.05, 10.0)
        self._latency_s = self._number("latency_s", 0.0, 1.0)
        self._session: Session | None = None
        self._period_s = SETPOINT_PERIOD_S
        # Counted by whichever thread stops, compared by the driver's own.
        self._stops = count(1)
        self._asked_stop = self._seen_stop = 0
        self._fault: str | None = None  # noted here, not on a board
        self._searched: set[str] = set()  # by a homing that is under way
        self._distrusted: set[str] = set()  # axes whose homing was ended before its end
        self._ended = False  # by a fault or refusal that was followed up
        self._progress = 0.0
        self._profile: Board | None = None
        self._called_s = float("-inf")  # host time of the latest call that goes on with anything

    @property
    def setpoint_period_s(self) -> float:
        """The interval of set-points, s: that of the boards once they were opened."""
        return self._period_s

    @property
    def stop_pending(self) -> bool:
        """Whether a board has yet to acknowledge a stop."""
        session = self._session
        return session is not None and (
            self._asked_stop != self._seen_stop
            or any(board.dialogue.has(Urgency.STOP) for board in session.boards)
        )

    def _open(self) -> None:
        try:
            axes = board_axes(self.robot)
        except InputError as error:
            raise DriverError(
                message("engine", "{name}: {error}").fill(name=self.name, error=str(error))
            ) from error
        urls = [str(self.settings["port"])]
        second = str(self.settings["second_port"])
        if second and len(axes) == 1:
            raise DriverError(
                message(
                    "engine", "{name}: robot {robot_name} has one board; leave second_port empty"
                ).fill(name=self.name, robot_name=repr(self.robot.name))
            )
        self._asked_stop = self._seen_stop = 0
        self._fault, self._progress, self._profile = None, 0.0, None
        self._searched, self._distrusted = set(), set()
        self._ended = False
        self._called_s = float("-inf")
        self._session = Session(
            self.robot,
            axes,
            [*urls, second] if second else urls,
            self._baud,
            latency_s=self._latency_s,
            watch_ms=round(1e3 * self._watchdog_s),
            clock=self.clock,
            pause=self._pause,
            open_port=self._open_port,
            permit=self.gate.permit(Purpose.SERVICE),
        )
        self._period_s = self._session.setpoint_period_s

    def _identify(self) -> MachineKind:
        virtual = all(board.kind == VIRTUAL for board in self._running.boards)
        return MachineKind.VIRTUAL if virtual else MachineKind.REAL

    def _close(self) -> None:
        session, self._session = self._session, None
        if session is not None:
            session.close()

    def _status(self) -> DeviceStatus:
        session = self._running
        boards = session.boards
        steppers = [n for n, axis in self.robot.axes.items() if isinstance(axis, StepperAxis)]
        # A board tells of all its axes at once.
        unhomed = tuple(
            axis.name
            for board in boards
            for axis in board.axes
            if axis.name in steppers and (board.unknown or axis.name in self._distrusted)
        )
        if session.lost is not None:
            return DeviceStatus(
                DeviceState.FAULT, self._progress, str(session.lost), False, unhomed
            )
        known = not self._distrusted and not any(board.unknown for board in boards)
        state, fault = self._state(session), self._fault_of(session)
        if fault is not None:
            state = DeviceState.FAULT
        return DeviceStatus(state, self._progress, fault, known, unhomed, session.silent_s)

    def _state(self, session: Session) -> DeviceState:
        if self._asked_stop != self._seen_stop:
            return DeviceState.MOVING  # until it is known what the stop did
        if session.player is not None:
            return DeviceState.PLAYING
        activities = {board.activity for board in session.boards}
        if busy := next((one for one in _BUSY if one in activities), None):
            return busy
        # The samples that show where they came to rest are to be there first.
        rested = max(board.rest_number for board in session.boards)
        return DeviceState.IDLE if session.sampling.settled >= rested else DeviceState.MOVING

    def _fault_of(self, session: Session) -> str | None:
        if self._asked_stop != self._seen_stop:
            return self._fault
        told = [board.fault for board in session.boards]
        found = [one for one in (*told, self._fault) if one is not None]
        return "; ".join(found) or None

    def _stop(self) -> None:
        session = self._session
        if session is None:
            return
        self._asked_stop = next(self._stops)
        failures = []
        for link in session.links:
            try:
                link.stop()
            except DriverError as error:  # the other board is to hear it all the same
                failures.append(error)
        if failures:
            raise failures[0]

    def _clear_fault(self, permit: Permit) -> None:
        session = self._running
        if session.lost is not None:
            raise DriverError(
                message("engine", "{name}: {lost}").fill(name=self.name, lost=str(session.lost))
            )
        self._follow_stop(session)
        self._fault = None
        for board in session.boards:
            board.orders.forget()
            if board.fault is not None:
                board.orders.clear_fault(permit)
        self._serve()

    def _read(self) -> Samples:
        session = self._running
        if session.lost is not None:
            raise ConnectionLostError(str(session.lost)) from session.lost
        self._serve()
        return session.samples()

    @property
    def _running(self) -> Session:
        assert self._session is not None, "the base class calls hooks of an open device only"
        return self._session

    def _serve(self) -> None:
        """Carry on with the conversation, after whatever stop came meanwhile."""
        session = self._running
        self._follow_stop(session)
        player = session.player
        session.serve()
        if player is not None:
            self._progress = player.progress
        self._note_faults(session)
        self._note_homing(session)

    def _note_homing(self, session: Session) -> None:
        """Trust the axes of a homing that has come to its end, and only those."""
        if self._searched and self._state(session) is not DeviceState.HOMING:
            if self._fault_of(session) is None and not session.silent_s:
                self._distrusted -= self._searched
            self._searched = set()

    def _note_faults(self, session: Session) -> None:
        """End what goes on where a board has halted or refused."""
        refused = [b.orders.refusal for b in session.boards if b.orders.refusal is not None]
        refused += session.held_back()
        player = session.player
        if player is not None and player.failure is not None:
            refused.append(player.failure)
        halted = any(board.fault is not None for board in session.boards)
        if refused:
            self._fault = "; ".join(refused)
        ends = bool(refused or halted) and not self._ended
        self._ended = bool(refused or halted)
        if ends and (player is not None or self._waits(session)):
            # What one board cannot do the other is not to do alone.
            self._profile = None
            self._stop()

    def _waits(self, session: Session) -> bool:
        return any(not board.at_rest and board.fault is None for board in session.boards)

    def _cancel_after_pause(self, session: Session) -> None:
        """End what was under way before a long pause of this program: nothing resumes by itself."""
        now_s = self.clock()
        paused_s, self._called_s = now_s - self._called_s, now_s
        under_way = session.player is not None or not all(one.at_rest for one in session.boards)
        if not MAX_PAUSE_S < paused_s < float("inf") or not under_way or session.lost is not None:
            return
        self._fault = message(
            "engine",
            "this program did not run for {seconds} s, at most {limit} s are allowed while axes "
            "move; all motion was cancelled. Check the machine, clear the fault and move again",
        ).fill(seconds=rounded(paused_s, 3), limit=rounded(MAX_PAUSE_S))
        with suppress(DriverError):  # the exchange that follows says why a port takes no stop
            self._stop()

    def _follow_stop(self, session: Session) -> None:
        """Forget what was asked before the latest stop, or a pause of this program."""
        self._cancel_after_pause(session)
        asked = self._asked_stop
        if asked != self._seen_stop:
            session.stopped()
            self._profile = None
            self._searched = set()
            self._seen_stop = asked

    def _prepare(self, action: str) -> None:
        """Refuse to move with parameters that nobody knows; what is asked now is after any stop."""
        self._follow_stop(self._running)
        self._running.trust.demand(self.name, action)

    def _number(self, name: str, least: float, greatest: float) -> float:
        value = self.settings[name]
        if isinstance(value, str) or not least <= value <= greatest:
            raise SettingError(
                message(
                    "engine",
                    "{name}: setting {setting} = {value} is not between {least} and {greatest}",
                ).fill(
                    name=self.name, setting=name, value=repr(value), least=least, greatest=greatest
                )
            )
        return value
