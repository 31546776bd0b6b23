"""The driver contract: the base class owns the rules, a driver fills small hooks.

A driver is made without touching its device, opened, used by one thread, and closed. ``stop`` is
the exception: any thread may call it at any time. What only some devices can do is a small base
class of its own (:class:`TrajectoryPlayer`), to be inherited beside others.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import ClassVar, final

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import LimitError, ProtocolError, StateError
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.drivers.settings import SettingValue, resolve
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import AxisEffect, Robot
from rotemina.sim.trajectory.checked import CheckedTrajectory, accepted
from rotemina.sim.trajectory.kinematics import SETPOINT_PERIOD_S
from rotemina.sim.trajectory.limits import check_target

_CLOSED = DeviceStatus(DeviceState.CLOSED)


class Driver(ABC):
    """A device that moves the axes of a robot.

    Parameters
    ----------
    robot : Robot
        The machine that the device is to be; its limits bind every target.
    settings : mapping
        Values for names in ``default_settings``; the type of a default is the type of the value.
    clock : callable
        The host's time, s.

    Raises
    ------
    SettingError
        For an unknown setting or a value of the wrong type.
    """

    api_version: ClassVar[int] = 1
    #: How screens and records call the device.
    name: ClassVar[str] = "device"
    #: Whether the device lives on ``clock`` alone, and so can run faster than real time.
    virtual_time: ClassVar[bool] = False
    default_settings: ClassVar[Mapping[str, SettingValue]] = MappingProxyType({})

    def __init__(
        self,
        robot: Robot,
        settings: Mapping[str, object] | None = None,
        *,
        clock: Clock = time.monotonic,
    ) -> None:
        self.robot = robot
        self.axes = tuple(robot.axes)
        self.settings = MappingProxyType(resolve(self.default_settings, settings or {}, self.name))
        self.clock = clock
        self._is_open = False
        self._last_time_s = float("-inf")

    def __init_subclass__(cls) -> None:
        """Refuse a subclass that overrides a rule of the contract instead of a hook."""
        super().__init_subclass__()
        for base in cls.__mro__[1:]:
            for name, member in vars(base).items():
                # Compared as found: a class mixed in from elsewhere must not override either.
                if getattr(member, "__final__", False) and getattr(cls, name) is not member:
                    raise TypeError(
                        f"{cls.__name__}.{name}: final in {base.__name__}; fill _{name}"
                    )

    @final
    def open(self) -> None:
        """Connect to the device, which holds where it stands.

        Raises
        ------
        StateError
            If it is open already.
        DriverError
            If the device cannot be reached or is not the one expected.
        """
        if self._is_open:
            raise StateError(f"{self.name}: it is open already; close it first")
        self._last_time_s = float("-inf")
        self._open()
        self._is_open = True

    @final
    def close(self) -> None:
        """Let go of the device; safe to call twice. It counts as closed even if this raises."""
        if not self._is_open:
            return
        self._is_open = False
        self._close()

    @final
    def status(self) -> DeviceStatus:
        """Return the device's state as of the last exchange with it; asks nothing, never waits."""
        return self._status() if self._is_open else _CLOSED

    @final
    def move_to(self, targets: Mapping[str, float]) -> None:
        """Begin to move axes to positions (m or rad); also in mid-move. Returns at once.

        Raises
        ------
        LimitError
            If any target is beyond a limit; then no axis moves.
        StateError
            If the device is closed, faulty or playing a trajectory.
        """
        state = self._require_sound("move")
        if state is DeviceState.PLAYING:
            raise StateError(f"{self.name}: a trajectory is playing; stop it before moving an axis")
        try:
            for axis, position in targets.items():
                check_target(self.robot, axis, position)
        except InputError as error:
            raise LimitError(str(error)) from error
        if targets:
            self._move_to(dict(targets))

    @final
    def stop(self) -> None:
        """Bring every axis to a halt and hold it there; ends a trajectory too.

        Any thread may call it at any time. It never waits, is not queued behind anything, and does
        nothing on a closed driver.
        """
        if self._is_open:
            self._stop()

    @final
    def clear_fault(self) -> None:
        """Acknowledge a fault: the device holds where it stands. Nothing happens without one.

        Raises
        ------
        StateError
            If the device is closed.
        DriverError
            If the fault persists.
        """
        self._require_open("clear a fault")
        if self._status().state is DeviceState.FAULT:
            self._clear_fault()

    @final
    def read(self) -> Samples:
        """Return what the device sampled since the last read; does not wait for more.

        Raises
        ------
        StateError
            If the device is closed.
        DriverError
            If the device does not answer, or answers nonsense.
        """
        self._require_open("read")
        samples = self._read()
        if samples.command.shape[1] != len(self.axes):
            count = samples.command.shape[1]
            raise ProtocolError(f"{self.name}: samples of {count} axes, expected {len(self.axes)}")
        if len(samples):
            if samples.device_time_s[0] <= self._last_time_s:
                raise ProtocolError(
                    f"{self.name}: device time went from {self._last_time_s:.9g} s back to "
                    f"{samples.device_time_s[0]:.9g} s; was the device reset?"
                )
            self._last_time_s = float(samples.device_time_s[-1])
        return samples

    def _require_open(self, action: str) -> None:
        if not self._is_open:
            raise StateError(f"{self.name}: cannot {action} while closed; open it first")

    def _require_sound(self, action: str) -> DeviceState:
        self._require_open(action)
        status = self._status()
        if status.state is DeviceState.FAULT:
            raise StateError(f"{self.name}: cannot {action} in a fault ({status.fault}); clear it")
        if not status.position_known:
            raise StateError(f"{self.name}: cannot {action} while the position is unknown")
        return status.state

    @abstractmethod
    def _open(self) -> None:
        """Connect; on failure leave nothing open behind."""

    @abstractmethod
    def _close(self) -> None:
        """Disconnect; the device holds."""

    @abstractmethod
    def _status(self) -> DeviceStatus:
        """Return what is known of an open device without asking it."""

    @abstractmethod
    def _move_to(self, targets: dict[str, float]) -> None:
        """Begin to move to targets that are inside every limit."""

    @abstractmethod
    def _stop(self) -> None:
        """Halt, from any thread, out of band, without waiting; the device is or was just open."""

    @abstractmethod
    def _clear_fault(self) -> None:
        """Acknowledge the present fault."""

    @abstractmethod
    def _read(self) -> Samples:
        """Return the samples since the last read."""


class TrajectoryPlayer(Driver, ABC):
    """A device that plays a whole trajectory on its own clock."""

    @property
    def setpoint_period_s(self) -> float:
        """How often the device applies set-points, s: it holds rows that are farther apart.

        A driver that knows its device says so here; trajectories are judged by it.
        """
        return SETPOINT_PERIOD_S

    @final
    def accept(self, trajectory: Record | CheckedTrajectory) -> CheckedTrajectory:
        """Return what :meth:`play` would play; asks the device nothing.

        One that was checked for this robot and set-point period is not checked again.

        Raises
        ------
        LimitError
            If the trajectory exceeds a limit or is not one for this robot.
        """
        try:
            return accepted(self.robot, trajectory, self.setpoint_period_s)
        except InputError as error:
            raise LimitError(str(error)) from error

    @final
    def play(self, trajectory: Record | CheckedTrajectory) -> None:
        """Begin to play the ``cmd`` channels of a trajectory. Returns at once.

        The device first goes to the first row within its limits and settles; its samples name the
        row of the trajectory that began to act. Axes that the trajectory does not name hold.

        Raises
        ------
        LimitError
            If the trajectory exceeds a limit or is not one for this robot or device.
        StateError
            If the device is closed, faulty, moving or playing.
        """
        state = self._require_sound("play")
        if state is not DeviceState.IDLE:
            raise StateError(f"{self.name}: it is still {state}; stop it or wait before playing")
        self._play(self.accept(trajectory).commands)

    @abstractmethod
    def _play(self, trajectory: Record) -> None:
        """Begin to play a trajectory that is inside every limit."""


class EffectCarrier(Driver, ABC):
    """A simulated device whose imperfections can be switched and tuned while it runs."""

    @property
    @abstractmethod
    def effects(self) -> tuple[AxisEffect, ...]:
        """The effects in place, those that are switched off among them; any thread may ask."""

    @final
    def check_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Raise :class:`EffectError` if effects cannot sit on the axes of this robot."""
        for effect in effects:
            Attached.of(self.robot, effect)

    @final
    def set_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Put effects in place of those before; the axes go on from where they are.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound; then nothing changes.
        StateError
            If the device is closed.
        """
        self._require_open("change its effects")
        self.check_effects(effects)
        self._set_effects(tuple(effects))

    @abstractmethod
    def _set_effects(self, effects: tuple[AxisEffect, ...]) -> None:
        """Put checked effects in place."""
