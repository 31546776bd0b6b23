"""The driver of the MC68HC11 boards: the contract's hooks, filled by one session of links.

All traffic happens in the calls of the one thread that uses the driver; only a stop is written to
the ports by whoever calls it.
"""

import time
from collections.abc import Callable, Mapping
from functools import partial
from itertools import count
from math import ceil
from types import MappingProxyType
from typing import ClassVar

from rotemina.drivers.abilities import (
    AnalogInputs,
    Capturer,
    Display,
    Homer,
    Linked,
    Parameterised,
    ProfileRunner,
    TrajectoryPlayer,
    VelocityMover,
    VoltageOutput,
)
from rotemina.drivers.capture import Captured, CaptureRates
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError, LimitError, StateError
from rotemina.drivers.link import LinkQuality
from rotemina.drivers.mc68hc11.axes import board_axes
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.capturing import Capturing
from rotemina.drivers.mc68hc11.codes import AXES, Ability
from rotemina.drivers.mc68hc11.dialogue import Request, Urgency
from rotemina.drivers.mc68hc11.joined import joined
from rotemina.drivers.mc68hc11.message import Message
from rotemina.drivers.mc68hc11.orders import said
from rotemina.drivers.mc68hc11.parameters import CODES, PER_AXIS
from rotemina.drivers.mc68hc11.player import Player
from rotemina.drivers.mc68hc11.port import OpenPort, open_port
from rotemina.drivers.mc68hc11.requests import (
    AbortProfile,
    Capture,
    Home,
    MoveTo,
    MoveVelocity,
    SetVoltage,
    ShowText,
    TriggerProfile,
)
from rotemina.drivers.mc68hc11.session import Session
from rotemina.drivers.mc68hc11.uploading import profile_messages
from rotemina.drivers.parameters import ParameterDifference
from rotemina.drivers.profile import Profile
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.trajectory.kinematics import SETPOINT_PERIOD_S

_LOW, _HIGH, _SPEED, _FIRST_MV, _LAST_MV = 0, 1, 2, 4, 5  # parameters of an axis
_MOST_SAMPLES = _MOST_PERIOD_US = 0xFFFF
_FULL_SCALE = 4095.0  # of 12 bits
_BUTTONS = 2
_BUSY = (DeviceState.HOMING, DeviceState.PLAYING, DeviceState.MOVING)


class MC68HC11(
    TrajectoryPlayer,
    VelocityMover,
    Homer,
    VoltageOutput,
    Capturer,
    ProfileRunner,
    AnalogInputs,
    Display,
    Parameterised,
    Linked,
):
    """One or two MC68HC11 boards at the end of serial lines.

    Settings: ``port``, a device or a URL of pyserial; ``second_port`` of the second board, empty
    for a robot of up to three axes, or for both boards on one shared bus; ``baud``; ``settle_s`` at
    the first row of a trajectory; ``watchdog_s``, after what silence of this program a board halts;
    ``latency_s``, what the operating system and adapters may add to a round trip.

    Parameters
    ----------
    robot, settings, clock
        See :class:`rotemina.drivers.driver.Driver`.
    open_port : callable
        Return an open port of a URL and a baud rate.
    pause : callable
        Let some seconds pass, while the boards are opened.
    """

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
        self._told_lost = False
        self._progress = 0.0
        self._profile: Board | None = None

    @property
    def setpoint_period_s(self) -> float:
        """The interval of telemetry and set-points, s: that of the boards once they were opened."""
        return self._period_s

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """The steppers; a piezo's sensor always knows where it is."""
        return tuple(n for n, axis in self.robot.axes.items() if isinstance(axis, StepperAxis))

    @property
    def capture_rates(self) -> CaptureRates:
        """As the boards announced; (0, 0) before they were opened."""
        rates = [b.rates for b in self._session.boards if b.rates] if self._session else []
        if not rates:
            return CaptureRates(0.0, 0.0, AXES, _MOST_SAMPLES)
        return CaptureRates(
            float(min(one.capture_one for one in rates)),
            float(min(one.capture_three for one in rates)),
            AXES,
            _MOST_SAMPLES,
        )

    @property
    def differences(self) -> tuple[ParameterDifference, ...]:
        """Where the boards' parameters differ from the robot file."""
        return self._session.trust.differences if self._session is not None else ()

    def link_quality(self) -> LinkQuality:
        """Return the counts of all lines together, and the worst of their times."""
        session = self._session
        return joined([link.quality() for link in session.links]) if session else LinkQuality()

    def analog_inputs(self) -> tuple[tuple[float, ...], tuple[bool, ...]]:
        """Return what the first board with a joystick told last; nothing before it did."""
        for board in self._session.boards if self._session is not None else ():
            if board.able(Ability.JOYSTICK) and (inputs := board.inputs) is not None:
                buttons = tuple(bool(inputs.buttons >> bit & 1) for bit in range(_BUTTONS))
                return tuple(one / _FULL_SCALE for one in inputs.readings()), buttons
        return (), ()

    def captured(self) -> Captured | None:
        """Return what has come of the capture since the last call."""
        session = self._session
        return session.capturing.take() if session is not None and session.capturing else None

    def _open(self) -> None:
        try:
            axes = board_axes(self.robot)
        except InputError as error:
            raise DriverError(f"{self.name}: {error}") from error
        urls = [str(self.settings["port"])]
        second = str(self.settings["second_port"])
        if second and len(axes) == 1:
            raise DriverError(
                f"{self.name}: robot {self.robot.name!r} has one board; leave second_port empty"
            )
        self._asked_stop = self._seen_stop = 0
        self._fault, self._told_lost, self._progress, self._profile = None, False, 0.0, None
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
        )
        self._period_s = self._session.period_s

    def _close(self) -> None:
        session, self._session = self._session, None
        if session is not None:
            session.close()

    def _status(self) -> DeviceStatus:
        session = self._running
        boards = session.boards
        steppers = self.homing_axes
        # A board tells of all its axes at once.
        unhomed = tuple(
            axis.name
            for board in boards
            if board.unknown
            for axis in board.axes
            if axis.name in steppers
        )
        if session.lost is not None:
            return DeviceStatus(
                DeviceState.FAULT, self._progress, str(session.lost), False, unhomed
            )
        known = not any(board.unknown for board in boards)
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
        return next((one for one in _BUSY if one in activities), DeviceState.IDLE)

    def _fault_of(self, session: Session) -> str | None:
        if self._asked_stop != self._seen_stop:
            return self._fault
        told = [board.fault for board in session.boards]
        found = [one for one in (*told, self._fault) if one is not None]
        return "; ".join(found) or None

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float]) -> None:
        self._demand_trust("move")
        for name, target in targets.items():
            board, axis = self._running.board_of(name)
            low, high = self._ends(name)
            steps = min(max(axis.steps(target), low), high)
            most = self._speed(name)
            if name in speeds:
                most = min(max(axis.steps(speeds[name]), 1), most)
            message = MoveTo(axis.number, steps, most)
            board.orders.give(("axis", axis.number), partial(said, message))
        self._serve()

    def _move_velocity(self, velocities: dict[str, float], lease_s: float) -> None:
        self._demand_trust("move")
        now_s = self.clock()
        for name, velocity in velocities.items():
            board, axis = self._running.board_of(name)
            most = self._speed(name)
            speed = min(max(axis.steps(velocity), -most), most)
            # What is said late is vouched for by no longer than it was asked; a halt always is.
            expires_s = now_s + 0.5 * lease_s if speed else float("inf")
            make = partial(_velocity, axis.number, speed, now_s + lease_s)
            board.orders.give(("axis", axis.number), make, expires_s=expires_s)
        self._serve()

    def _home(self, axes: tuple[str, ...]) -> None:
        self._demand_trust("home")
        session = self._running
        for board in session.boards:
            own = [axis.number for axis in board.axes if axis.name in axes]
            if own:
                message = Home(sum(1 << number for number in own))
                board.orders.give("home", partial(said, message), DeviceState.HOMING)
        self._serve()

    def _set_voltage(self, axis: str, voltage: float) -> None:
        self._demand_trust("put out a voltage")
        board, own = self._running.board_of(axis)
        trust = self._running.trust
        first = 1e-3 * trust.value(board, PER_AXIS * own.number + _FIRST_MV)
        last = 1e-3 * trust.value(board, PER_AXIS * own.number + _LAST_MV)
        code = min(max(round((voltage - first) / (last - first) * CODES), 0), CODES)
        message = SetVoltage(own.number, code)
        board.orders.give(("axis", own.number), partial(said, message))
        self._serve()

    def _play(self, trajectory: Record) -> None:
        self._demand_trust("play")
        session = self._running
        for board in session.boards:
            if not board.able(Ability.SETPOINTS):
                raise StateError(f"{self.name}: {board.where} cannot play trajectories")
        speeds = {name: self._speed(name) for name in self.axes}
        ends = {name: self._ends(name) for name in self.axes}
        session.player = session.playback = Player(
            trajectory, session.boards, speeds, ends, self._settle_s
        )
        self._progress = 0.0
        self._serve()

    def _capture(self, axes: tuple[str, ...], rate_hz: float, count: int) -> None:
        session = self._running
        boards = {session.board_of(axis)[0] for axis in axes}
        if len(boards) > 1:
            raise LimitError(f"{self.name}: {', '.join(axes)} are not all on one board")
        board = boards.pop()
        period_us = ceil(1e6 / rate_hz * (1.0 - 1e-9))
        if period_us > _MOST_PERIOD_US:
            raise LimitError(
                f"{self.name}: a capture at {rate_hz:g} Hz: {1e6 / _MOST_PERIOD_US:.3g} Hz at least"
            )
        on_clock = session.sampling.time_s if board is session.boards[0] else session.second_time_s
        run = Capturing(board, axes, period_us, count, on_clock)
        dialogue = board.link.dialogues[board.address]
        if session.capturing is not None:
            old = session.capturing.board
            old.link.dialogues[old.address].ask(
                Request(message=Capture(0, 0, 0), urgency=Urgency.BACKGROUND)
            )
        session.capturing = run
        if board.rates is not None and board.rates.telemetry_while_capturing:
            session.slow_down(board, 1000 // board.rates.telemetry_while_capturing)
        dialogue.ask(
            Request(
                message=Capture(run.mask, period_us, count),
                urgency=Urgency.BACKGROUND,
                answered=lambda _, now_s: run.granted(board.clock.time_us(now_s)),
                refused=lambda _: run.refused(),
            )
        )
        self._serve()

    def _commanded(self, axis: str) -> float:
        board, own = self._running.board_of(axis)
        return own.value(board.commanded()[own.number])

    def _upload(self, profile: Profile) -> None:
        self._demand_trust("take a profile")
        board, axis = self._running.board_of(profile.axis)
        if not board.able(Ability.PROFILE):
            raise StateError(f"{self.name}: {board.where} cannot run profiles")
        for index, message in enumerate(profile_messages(profile, axis)):
            board.orders.give(("profile", index), partial(said, message))
        self._profile = board
        self._serve()

    def _trigger(self) -> None:
        if self._profile is None:
            raise StateError(f"{self.name}: there is no profile to run; upload one first")
        orders = self._profile.orders
        orders.give("trigger", partial(said, TriggerProfile()), DeviceState.PLAYING)
        self._profile = None
        self._serve()

    def _abort(self) -> None:
        self._profile = None
        for board in self._running.boards:
            if board.able(Ability.PROFILE):
                board.orders.forget()
                board.orders.give("abort", partial(said, AbortProfile()))
        self._serve()

    def _show(self, row: int, text: str) -> None:
        for board in self._running.boards:
            if board.able(Ability.DISPLAY):
                message = ShowText(row, 0, text.encode("ascii", "replace"))
                board.link.dialogues[board.address].ask(
                    Request(message=message, urgency=Urgency.BACKGROUND)
                )
                return self._serve()
        raise StateError(f"{self.name}: no board has a display")

    def _accept_parameters(self) -> None:
        self._running.trust.accept()

    def _write_parameters(self) -> None:
        self._running.trust.write()
        self._serve()

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

    def _clear_fault(self) -> None:
        session = self._running
        if session.lost is not None:
            raise DriverError(f"{self.name}: {session.lost}")
        self._fault = None
        for board in session.boards:
            board.orders.forget()
            if board.fault is not None:
                board.orders.clear_fault()
        self._serve()

    def _read(self) -> Samples:
        session = self._running
        if session.lost is not None and not self._told_lost:
            self._told_lost = True
            raise session.lost
        self._serve()
        return session.samples()

    @property
    def _running(self) -> Session:
        assert self._session is not None, "the base class calls hooks of an open device only"
        return self._session

    def _serve(self) -> None:
        """Carry on with the conversation, after whatever stop came meanwhile."""
        session = self._running
        asked = self._asked_stop
        if asked != self._seen_stop:
            session.stopped()
            self._profile = None
            self._seen_stop = asked
        player = session.player
        try:
            session.serve()
        except DriverError:
            self._told_lost = True
            raise
        if player is not None:
            self._progress = player.progress
        self._note_faults(session)

    def _note_faults(self, session: Session) -> None:
        """End what goes on where a board has halted or refused."""
        refused = [b.orders.refusal for b in session.boards if b.orders.refusal is not None]
        player = session.player
        if player is not None and player.failure is not None:
            refused.append(player.failure)
        halted = any(board.fault is not None for board in session.boards)
        if refused:
            self._fault = "; ".join(refused)
        if (refused or halted) and (player is not None or self._waits(session)):
            # What one board cannot do the other is not to do alone.
            self._profile = None
            self._stop()

    def _waits(self, session: Session) -> bool:
        return any(not board.at_rest and board.fault is None for board in session.boards)

    def _demand_trust(self, action: str) -> None:
        self._running.trust.demand(self.name, action)

    def _ends(self, name: str) -> tuple[int, int]:
        """Return the first and the last step that both the robot file and the board allow."""
        board, axis = self._running.board_of(name)
        low, high = axis.ends(*self.robot.axes[name].range)
        trust, first = self._running.trust, PER_AXIS * axis.number
        own_low, own_high = trust.value(board, first + _LOW), trust.value(board, first + _HIGH)
        return max(low, own_low), min(high, own_high)

    def _speed(self, name: str) -> int:
        """Return the greatest speed that both the robot file and the board allow, steps/s."""
        board, axis = self._running.board_of(name)
        trust, index = self._running.trust, PER_AXIS * axis.number + _SPEED
        return max(1, min(trust.wanted(board, index), trust.value(board, index)))

    def _number(self, name: str, least: float, greatest: float) -> float:
        value = self.settings[name]
        if isinstance(value, str) or not least <= value <= greatest:
            raise SettingError(
                f"{self.name}: setting {name} = {value!r} is not between {least:g} and {greatest:g}"
            )
        return value


def _velocity(axis: int, speed: int, end_s: float, now_s: float) -> Message:
    left_ms = ceil(1e3 * (end_s - now_s)) if speed else 1
    return MoveVelocity(axis, speed, max(left_ms, 1))
