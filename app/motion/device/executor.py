"""Executes commands as driver calls, on the only thread that talks to the driver."""

from collections import deque
from collections.abc import Callable, Mapping
from types import MappingProxyType

from rotemina.app.motion.device.held_inverses import HostInverses
from rotemina.app.motion.device.mailbox import (
    ClearFaultCommand,
    Command,
    DriverCallCommand,
    EffectsCommand,
    HomeCommand,
    InverseCommand,
    LoadProfileCommand,
    LoopCommand,
    MoveCommand,
    PlayCommand,
    RunProfileCommand,
    VelocityCommand,
    VoltageCommand,
)
from rotemina.app.motion.device.sensor_corrections import SensorCorrections
from rotemina.app.motion.limits import PathSegment
from rotemina.app.motion.state import PlaybackRecorder
from rotemina.drivers.abilities import (
    AxisHomer,
    AxisRegulator,
    EffectCarrier,
    HysteresisCompensator,
    ProfileRunner,
    TrajectoryPlayer,
    VelocityMover,
    VoltageOutput,
)
from rotemina.drivers.contract import (
    Clock,
    DeviceState,
    Driver,
    Permit,
    PermitPurpose,
    StalePermitError,
    StateError,
)

_NO_TARGETS: Mapping[str, float] = MappingProxyType({})
_NO_DRIVES: Mapping[str, VelocityCommand] = MappingProxyType({})


class CommandExecutor:
    """Passes commands to the driver, and the segments of a move one after the other.

    A move is not continued after a stop. If a driver still executes a command that a stop has
    invalidated, it is halted again.

    Attributes
    ----------
    targets : mapping axis -> float
        Latest target that was sent to the driver, m or rad, for each axis that may be on its way.
    ends : mapping axis -> float
        Positions of these axes after the remaining segments, m or rad.
    drives : mapping axis -> VelocityCommand
        Command of each axis that may still move at a speed. Like the other two it is replaced as a
        whole, so any thread may read it.
    """

    def __init__(
        self,
        driver: Driver,
        clock: Clock,
        corrections: SensorCorrections,
        inverses: HostInverses,
        playback_metadata: Callable[[], Mapping[str, str]] = dict,
    ) -> None:
        self.targets = self.ends = _NO_TARGETS
        self.velocity_commands: Mapping[str, VelocityCommand] = _NO_DRIVES
        self.recorder: PlaybackRecorder | None = None
        #: The axes of the latest search for limit switches.
        self.homed_axes: frozenset[str] = frozenset()
        self._driver = driver
        self._clock = clock
        self._corrections = corrections
        self._playback_metadata = playback_metadata
        self._inverses = inverses
        # The segments of a move that have not begun.
        self._remaining_segments: deque[PathSegment] = deque()
        # Permit of the latest motion that was passed to the driver.
        self._permit: Permit | None = None

    @property
    def between_segments(self) -> bool:
        """Whether a move has segments that have not begun."""
        return bool(self._remaining_segments) and self._permit is not None and self._permit.is_valid

    def execute(self, command: Command, permit: Permit) -> None:
        """Execute a command, or drop it if a stop has invalidated its permit.

        Raises
        ------
        InputError, DriverError
            If the driver refuses the command, or fails.
        """
        # The later segments of a move need its permit, so a request without motion that arrives
        # meanwhile must not replace it.
        is_motion = permit.purpose in (PermitPurpose.MOTION, PermitPurpose.HOMING)
        if is_motion:
            self._permit = permit
        try:
            self._dispatch(command, permit)
        except StalePermitError:
            # The gate refused the command before it reached the device.
            return
        if is_motion:
            self._halt_if_overtaken(permit)

    def continue_move(self) -> None:
        """Begin the next segment of a move when the previous one has ended.

        Raises
        ------
        InputError, DriverError
            If the driver refuses the segment, or fails; the rest of the move is then dropped.
        """
        if not self.between_segments:
            self._remaining_segments.clear()
            return
        status = self._driver.status()
        if status.state is not DeviceState.IDLE or status.silent_s > 0.0:
            return
        permit = self._permit
        assert permit is not None, "a move is under way"
        try:
            self._start_next_segment(permit)
        except StalePermitError:
            self._drop_remaining_segments()
        except Exception:
            self._drop_remaining_segments()
            raise
        self._halt_if_overtaken(permit)

    def note_rest(self) -> None:
        """Forget the speeds of the axes, because the machine has come to rest."""
        self.velocity_commands = _NO_DRIVES

    def forget(self) -> None:
        """Forget all requested motion."""
        self._remaining_segments.clear()
        self.targets = self.ends = _NO_TARGETS
        self.velocity_commands = _NO_DRIVES

    def _drop_remaining_segments(self) -> None:
        self._remaining_segments.clear()
        self.ends = self.targets

    def _halt_if_overtaken(self, permit: Permit) -> None:
        """Halt again if a stop came meanwhile, in case a driver without a gate ignored it."""
        if not permit.is_valid:
            self.forget()
            self._driver.halt()

    def _dispatch(self, command: Command, permit: Permit) -> None:
        driver = self._driver
        if isinstance(command, MoveCommand):
            self._drop_remaining_segments()
            self._remaining_segments.extend(command.segments)
            self._start_next_segment(permit)
            self.ends = MappingProxyType({**self.targets, **command.targets})
        elif isinstance(command, VelocityCommand):
            self._start_velocity(command, permit)
        elif isinstance(command, PlayCommand):
            self._start_playback(command, permit)
        elif isinstance(command, LoadProfileCommand | RunProfileCommand | VoltageCommand):
            self._execute_voltage_or_profile(command, permit)
        elif isinstance(command, HomeCommand):
            assert isinstance(driver, AxisHomer), "the session has checked the driver"
            driver.home(command.axes, permit=permit)
            self.homed_axes = frozenset(command.axes)
            self.forget()
        elif isinstance(command, EffectsCommand | InverseCommand | LoopCommand):
            self._change_signal_chain(command, permit)
        elif isinstance(command, ClearFaultCommand):
            driver.clear_fault(permit=permit)
            self._inverses.forget()
            self.forget()
        elif isinstance(command, DriverCallCommand):
            permit.check()
            command.action(driver, permit)

    def _change_signal_chain(
        self, command: EffectsCommand | InverseCommand | LoopCommand, permit: Permit
    ) -> None:
        driver = self._driver
        if isinstance(command, EffectsCommand):
            assert isinstance(driver, EffectCarrier), "the session has checked the driver"
            driver.set_effects(command.effects, permit=permit)
            return
        if isinstance(command, LoopCommand):
            assert isinstance(driver, AxisRegulator), "the session has checked the driver"
            driver.regulate(command.axis, command.regulation, permit=permit)
        elif isinstance(driver, HysteresisCompensator):
            driver.compensate(command.axis, command.model, permit=permit)
        else:
            if driver.status().state is not DeviceState.IDLE:
                raise StateError(
                    "a compensation cannot be changed while the machine moves; stop it or wait"
                )
            permit.check()
            self._inverses.set_inverse(command.axis, command.model)
        # From now on the same command of the axis means another position.
        self.forget()

    def _execute_voltage_or_profile(
        self, command: LoadProfileCommand | RunProfileCommand | VoltageCommand, permit: Permit
    ) -> None:
        driver = self._driver
        if isinstance(command, VoltageCommand):
            assert isinstance(driver, VoltageOutput), "the session has checked the driver"
            self._inverses.refuse_voltage(command.axis)
            driver.set_voltage(command.axis, command.voltage, permit=permit)
            self.targets = self.ends = MappingProxyType({**self.targets, **command.targets})
            return
        assert isinstance(driver, ProfileRunner), "the session has checked the driver"
        if isinstance(command, LoadProfileCommand):
            driver.upload(self._inverses.convert_profile(command.profile), permit=permit)
            return
        driver.trigger(permit=permit)
        self.forget()
        self.targets = self.ends = command.targets

    def _start_next_segment(self, permit: Permit) -> None:
        segment = self._remaining_segments.popleft()
        targets, speeds = self._inverses.convert_targets(segment.targets, segment.speeds)
        self._driver.move_to(targets, speeds, permit=permit)
        self.targets = MappingProxyType({**self.targets, **segment.targets})

    def _start_velocity(self, command: VelocityCommand, permit: Permit) -> None:
        driver = self._driver
        assert isinstance(driver, VelocityMover), "the session has checked the driver"
        remaining_s = command.requested_s + command.lease_s - self._clock()
        if remaining_s <= 0.0:
            # The lease ran out in the queue.
            return
        self._drop_remaining_segments()
        velocities = self._inverses.convert_velocities(command.velocities, command.travels)
        driver.move_velocity(velocities, remaining_s, permit=permit)
        axes = command.velocities.keys()
        targets = {axis: target for axis, target in self.targets.items() if axis not in axes}
        self.targets = self.ends = MappingProxyType(targets)
        self.velocity_commands = MappingProxyType(
            {**self.velocity_commands, **dict.fromkeys(axes, command)}
        )

    def _start_playback(self, command: PlayCommand, permit: Permit) -> None:
        driver = self._driver
        assert isinstance(driver, TrajectoryPlayer), "the session has checked the driver"
        recorder = PlaybackRecorder(
            command.trajectory,
            driver.name,
            calibrations=self._corrections.names,
            compensations=command.compensations,
            loops=command.loops,
        )
        for key, text in self._playback_metadata().items():
            recorder.add_metadata(key, text)
        driver.play(command.converted or command.trajectory, permit=permit)
        if command.converted is not None:
            self._inverses.begin_playback(command.trajectory.commands)
        self.forget()
        self.recorder = recorder
