"""Executes commands as driver calls, on the only thread that talks to the driver."""

from collections import deque
from collections.abc import Callable, Mapping
from types import MappingProxyType

from rotemina.app.motion.guard import PathSegment
from rotemina.app.motion.held_inverses import HeldInverses
from rotemina.app.motion.mailbox import (
    Ask,
    ClearFault,
    Command,
    Compensate,
    Drive,
    Home,
    LoadProfile,
    Move,
    Play,
    Regulate,
    RunProfile,
    SetEffects,
    SetVoltage,
)
from rotemina.app.motion.recorder import PlaybackRecorder
from rotemina.app.motion.sensor_corrections import SensorCorrections
from rotemina.drivers.abilities import (
    Homer,
    ProfileRunner,
    TrajectoryPlayer,
    VelocityMover,
    VoltageOutput,
)
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.errors import StateError
from rotemina.drivers.gate import OvertakenError, Permit, Purpose
from rotemina.drivers.model_abilities import Compensator, EffectCarrier, Regulator
from rotemina.drivers.samples import DeviceState
from rotemina.sim.messages import message

_NOWHERE: Mapping[str, float] = MappingProxyType({})
_NO_DRIVES: Mapping[str, Drive] = MappingProxyType({})


class Executor:
    """Hands commands to the driver, and the segments of a move one after the other.

    ``targets`` is where the device was last sent, of each axis that it has been sent anywhere since
    it last held, ``ends`` where it is to be sent after that; ``drives`` the speeds that axes may
    still go at. All are replaced as a whole, so any thread may look at them. What a stop has
    overtaken is not gone on with, and halted again should a driver have let it slip through.
    """

    def __init__(
        self,
        driver: Driver,
        clock: Clock,
        corrections: SensorCorrections,
        inverses: HeldInverses,
        said_of_playback: Callable[[], Mapping[str, str]] = dict,
    ) -> None:
        self.targets = self.ends = _NOWHERE
        self.drives: Mapping[str, Drive] = _NO_DRIVES
        self.recorder: PlaybackRecorder | None = None
        #: The axes whose switches were looked for last.
        self.sought: frozenset[str] = frozenset()
        self._driver = driver
        self._clock = clock
        self._corrections = corrections
        self._said_of_playback = said_of_playback
        self._inverses = inverses
        self._route: deque[PathSegment] = deque()  # what is left of a move
        self._permit: Permit | None = None  # of the command that was handed over last

    @property
    def between_segments(self) -> bool:
        """Whether a part of a move is still to come."""
        return bool(self._route) and self._permit is not None and self._permit.valid

    def do(self, command: Command, permit: Permit) -> None:
        """Execute a command; drop it if a stop has overtaken it.

        Raises
        ------
        InputError, DriverError
            As the driver refuses it, or fails.
        """
        # A question that comes meanwhile does not take the place of the move it comes in.
        moves = permit.purpose in (Purpose.MOTION, Purpose.HOMING)
        if moves:
            self._permit = permit
        try:
            self._hand_over(command, permit)
        except OvertakenError:
            return  # nothing of it has reached the device
        if moves:
            self._halt_if_overtaken(permit)

    def go_on(self) -> None:
        """Begin the next segment of a move when the one before has ended.

        Raises
        ------
        InputError, DriverError
            As the driver refuses it, or fails; then nothing of the move is left.
        """
        if not self.between_segments:
            self._route.clear()
            return
        status = self._driver.status()
        if status.state is not DeviceState.IDLE or status.silent_s > 0.0:
            return
        permit = self._permit
        assert permit is not None, "a move is under way"
        try:
            self._next_segment(permit)
        except OvertakenError:
            self._leave_route()
        except Exception:
            self._leave_route()
            raise
        self._halt_if_overtaken(permit)

    def rested(self) -> None:
        """Note that the machine is at rest: no axis moves at a speed any longer."""
        self.drives = _NO_DRIVES

    def forget(self) -> None:
        """Forget all requested motion."""
        self._route.clear()
        self.targets = self.ends = _NOWHERE
        self.drives = _NO_DRIVES

    def _leave_route(self) -> None:
        """Go no further than the present segment."""
        self._route.clear()
        self.ends = self.targets

    def _halt_if_overtaken(self, permit: Permit) -> None:
        """Halt again: a driver that passes no gate must not undo a stop that came meanwhile."""
        if not permit.valid:
            self.forget()
            self._driver.halt()

    def _hand_over(self, command: Command, permit: Permit) -> None:
        driver = self._driver
        if isinstance(command, Move):
            self._leave_route()
            self._route.extend(command.segments)
            self._next_segment(permit)
            self.ends = MappingProxyType({**self.targets, **command.targets})
        elif isinstance(command, Drive):
            self._drive(command, permit)
        elif isinstance(command, Play):
            self._play(command, permit)
        elif isinstance(command, LoadProfile | RunProfile | SetVoltage):
            self._shortly(command, permit)
        elif isinstance(command, Home):
            assert isinstance(driver, Homer), "the session refuses on any other"
            driver.home(command.axes, permit=permit)
            self.sought = frozenset(command.axes)
            self.forget()
        elif isinstance(command, SetEffects | Compensate | Regulate):
            self._change(command, permit)
        elif isinstance(command, ClearFault):
            driver.clear_fault(permit=permit)
            self._inverses.forget()
            self.forget()
        elif isinstance(command, Ask):
            permit.check()
            command.action(driver, permit)

    def _change(self, command: SetEffects | Compensate | Regulate, permit: Permit) -> None:
        """Change the stages between commands and motion."""
        driver = self._driver
        if isinstance(command, SetEffects):
            assert isinstance(driver, EffectCarrier), "the session refuses on any other"
            driver.set_effects(command.effects, permit=permit)
            return
        if isinstance(command, Regulate):
            assert isinstance(driver, Regulator), "the session refuses on any other"
            driver.regulate(command.axis, command.regulation, permit=permit)
        elif isinstance(driver, Compensator):
            driver.compensate(command.axis, command.model, permit=permit)
        else:
            if driver.status().state is not DeviceState.IDLE:
                raise StateError(
                    message(
                        "engine", "cannot change a compensation while it moves; stop it or wait"
                    )
                )
            permit.check()
            self._inverses.change(command.axis, command.model)
        self.forget()  # its command is another now

    def _shortly(self, command: LoadProfile | RunProfile | SetVoltage, permit: Permit) -> None:
        """Execute commands other than moves that an axis performs on its own."""
        driver = self._driver
        if isinstance(command, SetVoltage):
            assert isinstance(driver, VoltageOutput), "the session refuses on any other"
            self._inverses.refuse_voltage(command.axis)
            driver.set_voltage(command.axis, command.voltage, permit=permit)
            self.targets = self.ends = MappingProxyType({**self.targets, **command.targets})
            return
        assert isinstance(driver, ProfileRunner), "the session refuses on any other"
        if isinstance(command, LoadProfile):
            driver.upload(self._inverses.profile(command.profile), permit=permit)
            return
        driver.trigger(permit=permit)
        self.forget()
        self.targets = self.ends = command.targets

    def _next_segment(self, permit: Permit) -> None:
        segment = self._route.popleft()
        targets, speeds = self._inverses.commands_for(segment.targets, segment.speeds)
        self._driver.move_to(targets, speeds, permit=permit)
        self.targets = MappingProxyType({**self.targets, **segment.targets})

    def _drive(self, command: Drive, permit: Permit) -> None:
        driver = self._driver
        assert isinstance(driver, VelocityMover), "the session refuses on any other"
        left_s = command.asked_s + command.lease_s - self._clock()
        if left_s <= 0.0:
            return  # nobody vouches for it any more
        self._leave_route()
        velocities = self._inverses.velocities(command.velocities, command.ways)
        driver.move_velocity(velocities, left_s, permit=permit)
        axes = command.velocities.keys()
        left = {a: t for a, t in self.targets.items() if a not in axes}
        self.targets = self.ends = MappingProxyType(left)
        self.drives = MappingProxyType({**self.drives, **dict.fromkeys(axes, command)})

    def _play(self, command: Play, permit: Permit) -> None:
        driver = self._driver
        assert isinstance(driver, TrajectoryPlayer), "the session refuses to play on any other"
        names = self._corrections.names
        recorder = PlaybackRecorder(
            command.trajectory,
            driver.name,
            calibrations=names,
            compensations=command.compensations,
            loops=command.loops,
        )
        for key, text in self._said_of_playback().items():
            recorder.say(key, text)
        driver.play(command.sent or command.trajectory, permit=permit)
        if command.sent is not None:
            self._inverses.play(command.trajectory.commands)
        self.forget()
        self.recorder = recorder
