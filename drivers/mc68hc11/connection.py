"""Connection of the driver: opens, serves, stops and closes the boards, and reports state."""

import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from itertools import count
from types import MappingProxyType
from typing import ClassVar

from rotemina.drivers.contract import (
    Clock,
    ConnectionLostError,
    DeviceSamples,
    DeviceState,
    DeviceStatus,
    Driver,
    DriverError,
    DriverSettingError,
    MachineKind,
    Permit,
    PermitPurpose,
    SettingValue,
)
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.dialogue import RequestUrgency
from rotemina.drivers.mc68hc11.driver_session import BoardSession
from rotemina.drivers.mc68hc11.protocol import VIRTUAL_KIND, make_board_axes
from rotemina.drivers.serial_lines import OpenPort, open_port
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.robot import Robot, StepperAxis
from rotemina.sim.trajectory import DEFAULT_SETPOINT_PERIOD_S

#: All motion is cancelled if this program does not run for a longer time. A busy computer causes
#: shorter pauses. A suspended one causes much longer pauses, and meanwhile the machine may change.
MAX_PAUSE_S = 1.0
_BUSY_STATES = (DeviceState.HOMING, DeviceState.PLAYING, DeviceState.MOVING)


class BoardConnection(Driver):
    """Connection to the boards; see :class:`rotemina.drivers.mc68hc11.driver.MC68HC11Driver`."""

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
        self._baud = int(self._read_number("baud", 300, 4_000_000))
        self._settle_s = self._read_number("settle_s", 0.0, 60.0)
        self._watchdog_s = self._read_number("watchdog_s", 0.05, 10.0)
        self._latency_s = self._read_number("latency_s", 0.0, 1.0)
        self._session: BoardSession | None = None
        self._setpoint_period_s = DEFAULT_SETPOINT_PERIOD_S
        # A stop increments the requested number, in any thread. The driver's own thread handles the
        # stop when it finds that the two numbers differ.
        self._stop_counter = count(1)
        self._requested_stop = self._handled_stop = 0
        # A fault that the driver has found, in contrast to faults that boards report.
        self._fault: str | None = None
        # Axes that are being homed now.
        self._axes_being_homed: set[str] = set()
        # Axes whose homing was started but not completed.
        self._untrusted_axes: set[str] = set()
        # Whether all boards were already stopped because of the current fault or refusal.
        self._has_stopped_after_fault = False
        self._progress = 0.0
        # The board with a profile that waits for its trigger.
        self._profile_board: Board | None = None
        # Host time of the latest call that continues any motion.
        self._last_call_s = float("-inf")

    @property
    def setpoint_period_s(self) -> float:
        """Interval between set-points, s. The boards determine it while they are open."""
        return self._setpoint_period_s

    @property
    def stop_pending(self) -> bool:
        """Whether some board has not yet acknowledged a stop."""
        session = self._session
        return session is not None and (
            self._requested_stop != self._handled_stop
            or any(board.dialogue.has_request(RequestUrgency.STOP) for board in session.boards)
        )

    def _open(self) -> None:
        try:
            axes = make_board_axes(self.robot)
        except InputError as error:
            raise DriverError("{name}: {error}", name=self.name, error=str(error)) from error
        urls = [str(self.settings["port"])]
        second_url = str(self.settings["second_port"])
        if second_url and len(axes) == 1:
            raise DriverError(
                "{name}: robot {robot_name} has one board; leave second_port empty",
                name=self.name,
                robot_name=repr(self.robot.name),
            )
        self._requested_stop = self._handled_stop = 0
        self._fault, self._progress, self._profile_board = None, 0.0, None
        self._axes_being_homed, self._untrusted_axes = set(), set()
        self._has_stopped_after_fault = False
        self._last_call_s = float("-inf")
        self._session = BoardSession(
            self.robot,
            axes,
            [*urls, second_url] if second_url else urls,
            self._baud,
            latency_s=self._latency_s,
            watchdog_ms=round(1e3 * self._watchdog_s),
            clock=self.clock,
            pause=self._pause,
            open_port=self._open_port,
            permit=self.gate.permit(PermitPurpose.SERVICE),
        )
        self._setpoint_period_s = self._session.setpoint_period_s

    def _identify(self) -> MachineKind:
        is_virtual = all(board.kind == VIRTUAL_KIND for board in self._open_session.boards)
        return MachineKind.VIRTUAL if is_virtual else MachineKind.REAL

    def _close(self) -> None:
        session, self._session = self._session, None
        if session is not None:
            session.close()

    def _status(self) -> DeviceStatus:
        session = self._open_session
        boards = session.boards
        steppers = [name for name, axis in self.robot.axes.items() if isinstance(axis, StepperAxis)]
        # A board reports one position state for all its axes together.
        unhomed = tuple(
            axis.name
            for board in boards
            for axis in board.axes
            if axis.name in steppers
            and (board.is_position_unknown or axis.name in self._untrusted_axes)
        )
        if session.loss is not None:
            return DeviceStatus(
                DeviceState.FAULT, self._progress, str(session.loss), False, unhomed
            )
        is_known = not self._untrusted_axes and not any(
            board.is_position_unknown for board in boards
        )
        state, fault = self._find_state(session), self._describe_fault(session)
        if fault is not None:
            state = DeviceState.FAULT
        return DeviceStatus(state, self._progress, fault, is_known, unhomed, session.silent_s)

    def _find_state(self, session: BoardSession) -> DeviceState:
        if self._requested_stop != self._handled_stop:
            # The effect of the stop is not known yet.
            return DeviceState.MOVING
        if session.player is not None:
            return DeviceState.PLAYING
        activities = {board.activity for board in session.boards}
        if busy_state := next((state for state in _BUSY_STATES if state in activities), None):
            return busy_state
        # The device counts as idle only when the samples with the final position have arrived.
        rest_number = max(board.rest_number for board in session.boards)
        return (
            DeviceState.IDLE
            if session.sample_assembler.latest_finished_number >= rest_number
            else DeviceState.MOVING
        )

    def _describe_fault(self, session: BoardSession) -> str | None:
        if self._requested_stop != self._handled_stop:
            return self._fault
        faults = [board.fault_text for board in session.boards]
        texts = [fault for fault in (*faults, self._fault) if fault is not None]
        return "; ".join(texts) or None

    def _stop(self) -> None:
        session = self._session
        if session is None:
            return
        self._requested_stop = next(self._stop_counter)
        failures = []
        for link in session.links:
            try:
                link.stop()
            except DriverError as error:
                # The other board must still receive the stop.
                failures.append(error)
        if failures:
            raise failures[0]

    def _clear_fault(self, permit: Permit) -> None:
        session = self._open_session
        if session.loss is not None:
            raise DriverError("{name}: {lost}", name=self.name, lost=str(session.loss))
        self._handle_stop(session)
        self._fault = None
        for board in session.boards:
            board.orders.drop_orders()
            if board.fault_text is not None:
                board.orders.clear_fault(permit)
        self._serve()

    def _read(self) -> DeviceSamples:
        session = self._open_session
        if session.loss is not None:
            raise ConnectionLostError(str(session.loss)) from session.loss
        self._serve()
        return session.take_samples()

    @property
    def _open_session(self) -> BoardSession:
        assert self._session is not None, "the base class calls hooks of an open device only"
        return self._session

    def _serve(self) -> None:
        session = self._open_session
        self._handle_stop(session)
        player = session.player
        session.serve()
        if player is not None:
            self._progress = player.progress
        self._handle_faults(session)
        self._update_homing(session)

    def _update_homing(self, session: BoardSession) -> None:
        """Trust the positions of the axes whose homing has been completed."""
        if self._axes_being_homed and self._find_state(session) is not DeviceState.HOMING:
            if self._describe_fault(session) is None and not session.silent_s:
                self._untrusted_axes -= self._axes_being_homed
            self._axes_being_homed = set()

    def _handle_faults(self, session: BoardSession) -> None:
        """Stop all boards if one of them has a fault or has refused an order."""
        refusals = [
            board.orders.refusal for board in session.boards if board.orders.refusal is not None
        ]
        refusals += session.take_rejection_reasons()
        player = session.player
        if player is not None and player.failure is not None:
            refusals.append(player.failure)
        has_board_fault = any(board.fault_text is not None for board in session.boards)
        if refusals:
            self._fault = "; ".join(refusals)
        must_stop = bool(refusals or has_board_fault) and not self._has_stopped_after_fault
        self._has_stopped_after_fault = bool(refusals or has_board_fault)
        if must_stop and (player is not None or self._is_any_board_moving(session)):
            # The other board must not continue alone.
            self._profile_board = None
            self._stop()

    def _is_any_board_moving(self, session: BoardSession) -> bool:
        return any(not board.at_rest and board.fault_text is None for board in session.boards)

    def _cancel_after_pause(self, session: BoardSession) -> None:
        """Cancel all motion after a long pause of this program. Nothing may resume by itself."""
        now_s = self.clock()
        paused_s, self._last_call_s = now_s - self._last_call_s, now_s
        is_moving = session.player is not None or not all(board.at_rest for board in session.boards)
        if not MAX_PAUSE_S < paused_s < float("inf") or not is_moving or session.loss is not None:
            return
        self._fault = message(
            "engine",
            "this program did not run for {seconds} s (limit {limit} s while axes move), so all "
            "motion was cancelled. Check the machine, clear the fault and move again",
        ).fill(seconds=format_rounded(paused_s, 3), limit=format_rounded(MAX_PAUSE_S))
        # If a port does not accept the stop, the next exchange reports the reason.
        with suppress(DriverError):
            self._stop()

    def _handle_stop(self, session: BoardSession) -> None:
        """Cancel all requests from before the latest stop, or before a long pause."""
        self._cancel_after_pause(session)
        requested_stop = self._requested_stop
        if requested_stop != self._handled_stop:
            session.handle_stop()
            self._profile_board = None
            self._axes_being_homed = set()
            self._handled_stop = requested_stop

    def _prepare_action(self, action: str) -> None:
        """Handle a pending stop, and refuse an action if parameters differ from the robot file."""
        self._handle_stop(self._open_session)
        self._open_session.parameter_check.require_agreement(self.name, action)

    def _read_number(self, name: str, min_value: float, max_value: float) -> float:
        value = self.settings[name]
        if isinstance(value, str) or not min_value <= value <= max_value:
            raise DriverSettingError(
                "{name}: setting {setting} = {value} is not between {least} and {greatest}",
                name=self.name,
                setting=name,
                value=repr(value),
                least=min_value,
                greatest=max_value,
            )
        return value
