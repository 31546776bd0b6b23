"""How commands become calls of the driver, on the thread that alone talks to it."""

from collections import deque
from collections.abc import Mapping
from types import MappingProxyType

from rotemina.app.motion.guard import Leg
from rotemina.app.motion.mailbox import (
    Ask,
    ClearFault,
    Command,
    Compensate,
    Drive,
    Home,
    LoadProfile,
    Mailbox,
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
from rotemina.drivers.model_abilities import Compensator, EffectCarrier, Regulator
from rotemina.drivers.samples import DeviceState

_NOWHERE: Mapping[str, float] = MappingProxyType({})
_NO_DRIVES: Mapping[str, Drive] = MappingProxyType({})


class Executor:
    """Hands commands to the driver, and the legs of a move one after the other.

    ``targets`` is where the device was last sent, of each axis that it has been sent anywhere since
    it last held; ``drives`` the speeds that axes may still go at. Both are replaced as a whole, so
    any thread may look at them. A stop is a new generation of the ``mailbox``: what was
    under way before it is not gone on with, and stopped again if it slipped through.
    """

    def __init__(
        self, driver: Driver, mailbox: Mailbox, clock: Clock, corrections: SensorCorrections
    ) -> None:
        self.targets = _NOWHERE
        self.drives: Mapping[str, Drive] = _NO_DRIVES
        self.recorder: PlaybackRecorder | None = None
        self._driver = driver
        self._mailbox = mailbox
        self._clock = clock
        self._corrections = corrections
        self._route: deque[Leg] = deque()  # what is left of a move
        self._generation = 0

    @property
    def between_legs(self) -> bool:
        """Whether a part of a move is still to come."""
        return bool(self._route) and self._generation == self._mailbox.generation

    def do(self, command: Command, generation: int) -> None:
        """Carry out a command that was taken from the mailbox at this generation of it.

        Raises
        ------
        InputError, DriverError
            As the driver refuses it, or fails.
        """
        self._generation = generation
        try:
            self._hand_over(command)
        finally:
            self._stop_if_overtaken()

    def go_on(self) -> None:
        """Begin the next leg of a move when the one before has ended.

        Raises
        ------
        InputError, DriverError
            As the driver refuses it, or fails; then nothing of the move is left.
        """
        if not self.between_legs:
            self._route.clear()
            return
        status = self._driver.status()
        if status.state is not DeviceState.IDLE or status.silent_s > 0.0:
            return
        try:
            self._next_leg()
        except Exception:
            self._route.clear()
            raise
        finally:
            self._stop_if_overtaken()

    def rested(self) -> None:
        """Note that the machine is at rest: nothing goes on at a speed."""
        self.drives = _NO_DRIVES

    def forget(self) -> None:
        """Forget all motion that was asked for."""
        self._route.clear()
        self.targets, self.drives = _NOWHERE, _NO_DRIVES

    def _stop_if_overtaken(self) -> None:
        """Stop again: a stop that came meanwhile must not be undone by what was on its way."""
        if self._mailbox.generation != self._generation:
            self.forget()
            self._driver.stop()

    def _hand_over(self, command: Command) -> None:
        driver = self._driver
        if isinstance(command, Move):
            self._route.clear()
            self._route.extend(command.legs)
            self._next_leg()
        elif isinstance(command, Drive):
            self._drive(command)
        elif isinstance(command, Play):
            self._play(command)
        elif isinstance(command, LoadProfile | RunProfile | SetVoltage):
            self._shortly(command)
        elif isinstance(command, Home):
            assert isinstance(driver, Homer), "the session refuses on any other"
            driver.home(command.axes)
            self.forget()
        elif isinstance(command, SetEffects | Compensate | Regulate):
            self._change(command)
        elif isinstance(command, ClearFault):
            driver.clear_fault()
            self.forget()
        elif isinstance(command, Ask):
            command.action(driver)

    def _change(self, command: SetEffects | Compensate | Regulate) -> None:
        """Change what stands between commands and motion."""
        driver = self._driver
        if isinstance(command, SetEffects):
            assert isinstance(driver, EffectCarrier), "the session refuses on any other"
            driver.set_effects(command.effects)
            return
        if isinstance(command, Regulate):
            assert isinstance(driver, Regulator), "the session refuses on any other"
            driver.regulate(command.axis, command.regulation)
        else:
            assert isinstance(driver, Compensator), "the session refuses on any other"
            driver.compensate(command.axis, command.model)
        self.forget()  # its command is another now

    def _shortly(self, command: LoadProfile | RunProfile | SetVoltage) -> None:
        """Carry out what an axis does by itself, beside moves."""
        driver = self._driver
        if isinstance(command, SetVoltage):
            assert isinstance(driver, VoltageOutput), "the session refuses on any other"
            driver.set_voltage(command.axis, command.voltage)
            self.targets = MappingProxyType({**self.targets, **command.targets})
            return
        assert isinstance(driver, ProfileRunner), "the session refuses on any other"
        if isinstance(command, LoadProfile):
            driver.upload(command.profile)
            return
        driver.trigger()
        self.forget()
        self.targets = command.targets

    def _next_leg(self) -> None:
        leg = self._route.popleft()
        self._driver.move_to(leg.targets, leg.speeds)
        self.targets = MappingProxyType({**self.targets, **leg.targets})

    def _drive(self, command: Drive) -> None:
        driver = self._driver
        assert isinstance(driver, VelocityMover), "the session refuses on any other"
        left_s = command.asked_s + command.lease_s - self._clock()
        if left_s <= 0.0:
            return  # nobody vouches for it any more
        self._route.clear()
        driver.move_velocity(command.velocities, left_s)
        axes = command.velocities.keys()
        self.targets = MappingProxyType({a: t for a, t in self.targets.items() if a not in axes})
        self.drives = MappingProxyType({**self.drives, **dict.fromkeys(axes, command)})

    def _play(self, command: Play) -> None:
        driver = self._driver
        assert isinstance(driver, TrajectoryPlayer), "the session refuses to play on any other"
        names = self._corrections.names
        recorder = PlaybackRecorder(
            command.trajectory,
            driver.name,
            calibrations=names,
            compensations=command.compensations,
            loops=command.loops,
            rowwise=command.sent is not None,
        )
        driver.play(command.sent or command.trajectory)
        self.forget()
        self.recorder = recorder
