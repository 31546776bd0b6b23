"""The driver contract: the base class enforces the rules, and a driver implements small hooks.

Creating a driver does not access the device. One thread then opens, uses and closes the driver.
Only ``stop`` may be called by any thread at any time. Abilities that only some devices have are
separate base classes (:mod:`rotemina.drivers.abilities`), from which a driver may inherit.

Every command that moves something passes the driver's gate (:mod:`rotemina.drivers.contract.gate`)
immediately before it reaches the device: a hook receives a permit, and writes to the device inside
``with permit.passing():``.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from contextlib import suppress
from enum import StrEnum
from types import MappingProxyType
from typing import ClassVar, final

from rotemina.drivers.contract.axes import DeviceAxis
from rotemina.drivers.contract.errors import LimitError, ProtocolError, StateError
from rotemina.drivers.contract.gate import Gate, Permit, PermitPurpose
from rotemina.drivers.contract.samples import DeviceSamples, DeviceState, DeviceStatus
from rotemina.drivers.contract.settings import SettingValue, resolve_settings
from rotemina.sim.compatibility import adopt_former_methods
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.plugin_points import API_VERSIONS
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import check_speeds, check_target

# A clock of the host, real or virtual, returns ``host_time_s``.
Clock = Callable[[], float]


class VirtualClock:
    """A clock that is advanced manually, for tests and fast playback."""

    def __init__(self, host_time_s: float = 0.0) -> None:
        self._host_time_s = host_time_s

    def __call__(self) -> float:
        """Return the current ``host_time_s``."""
        return self._host_time_s

    def advance(self, seconds: float) -> None:
        """Advance by ``seconds``, which must not be negative."""
        if not seconds >= 0:
            raise ValueError(f"the clock cannot advance by {seconds} s: must be 0 s or more")
        self._host_time_s += seconds


_CLOSED = DeviceStatus(DeviceState.CLOSED)


class MachineKind(StrEnum):
    """The kind of machine that a driver moves."""

    REAL = "real"
    #: A program at the other end of the line behaves like the device, byte for byte.
    VIRTUAL = "virtual"
    #: The driver itself simulates the machine; there is no device.
    SIMULATED = "simulated"


class Driver(ABC):
    """A device that moves the axes of a robot.

    Parameters
    ----------
    robot : Robot
        The machine that the device moves. Its limits apply to every target.
    settings : mapping
        Values by name. The names and the types of the values are those of ``default_settings``.
    clock : callable
        Returns the host's time, s.

    Raises
    ------
    DriverSettingError
        If a setting is unknown, or its value has the wrong type.
    """

    #: The version of this interface for which the class was written.
    api_version: ClassVar[int] = API_VERSIONS["rotemina.drivers"]
    #: Name of the device on screens and in records.
    name: ClassVar[str] = "device"
    #: Whether ``clock`` is the device's only source of time, so that it can run faster than real
    #: time.
    virtual_time: ClassVar[bool] = False
    #: Longest interval between two calls of :meth:`read`, in which a driver serves its line, s.
    service_period_s: ClassVar[float] = 0.01
    #: Largest error of a sample's time, s, if the device has no clock; 0 if it has one.
    stamp_error_s: float = 0.0
    default_settings: ClassVar[Mapping[str, SettingValue]] = MappingProxyType({})
    #: The machine kind, if the driver knows it without asking a device.
    built_in_kind: ClassVar[MachineKind | None] = None

    def __init__(
        self,
        robot: Robot,
        settings: Mapping[str, object] | None = None,
        *,
        clock: Clock = time.monotonic,
    ) -> None:
        self.robot = robot
        self.axes = tuple(robot.axes)
        self.settings = MappingProxyType(
            resolve_settings(self.default_settings, settings or {}, self.name)
        )
        self.clock = clock
        #: Every motion passes this gate. The session that uses the driver replaces it with its own.
        self.gate = Gate(clock)
        self._is_open = False
        self._machine_kind = self.built_in_kind
        self._last_time_s = float("-inf")

    def __init_subclass__(cls) -> None:
        """Refuse a subclass that overrides a rule of the contract instead of a hook."""
        super().__init_subclass__()
        adopt_former_methods(cls)
        for base in cls.__mro__[1:]:
            for name, member in vars(base).items():
                # getattr searches all base classes, so a mixin cannot override a rule either.
                function = member.fget if isinstance(member, property) else member
                if getattr(function, "__final__", False) and getattr(cls, name) is not member:
                    raise TypeError(
                        f"{cls.__name__}.{name}: final in {base.__name__}; fill _{name}"
                    )

    @final
    def open(self) -> None:
        """Connect to the device, which holds its position.

        Raises
        ------
        StateError
            If it is already open.
        DriverError
            If the device cannot be reached or is not the expected one.
        """
        if self._is_open:
            raise StateError("{name} is already open; close it first", name=self.name)
        self._last_time_s = float("-inf")
        self._open()
        try:
            self._machine_kind = MachineKind(self._identify())
        except BaseException:
            # Report the first failure, not a failure to close.
            with suppress(Exception):
                self._close()
            raise
        self._is_open = True

    @final
    def close(self) -> None:
        """Release the device; safe to call twice. The driver counts as closed even if it raises."""
        if not self._is_open:
            return
        self._is_open = False
        self._close()

    @property
    @final
    def machine_kind(self) -> MachineKind:
        """The kind of machine that the driver moves; may be read on any thread.

        The device reports it when it is opened, and counts as real until then. The value is kept
        after the device is closed or lost.
        """
        return self._machine_kind or MachineKind.REAL

    @property
    @final
    def is_identified(self) -> bool:
        """Whether :attr:`machine_kind` is known and not only assumed; for any thread."""
        return self._machine_kind is not None

    @property
    def stop_pending(self) -> bool:
        """Whether the device has not confirmed a stop yet.

        A device that does not confirm stops counts as stopped at once.
        """
        return False

    @property
    def descriptions(self) -> tuple[DeviceAxis, ...]:
        """The axes, in the order of the robot file.

        A driver whose device reports better data than the robot file overrides this property.
        """
        return tuple(DeviceAxis.of(self.robot, axis) for axis in self.axes)

    @final
    def status(self) -> DeviceStatus:
        """Return the state as of the last exchange with the device; sends nothing, never waits."""
        return self._status() if self._is_open else _CLOSED

    @final
    def move_to(
        self,
        targets: Mapping[str, float],
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        permit: Permit | None = None,
    ) -> None:
        """Start moving axes to positions (m or rad), also during a move. Returns at once.

        Each axis moves at its maximum speed, or at its speed in ``speeds`` (m/s or rad/s) if that
        is lower. ``permit`` is the permit of the request; if it is None, a new permit is drawn.

        Raises
        ------
        LimitError
            If a target is beyond a limit or a speed is invalid; then no axis moves.
        StateError
            If the device is closed, has a fault, or plays a trajectory.
        GateError
            If the machine was stopped after the permit was drawn, or motion is locked.
        """
        permit = self._require_permit(permit)
        self._require_not_busy("move")
        try:
            for axis, position in targets.items():
                check_target(self.robot, axis, position)
            check_speeds(targets, speeds)
        except InputError as error:
            raise LimitError(str(error)) from error
        if targets:
            self._move_to(dict(targets), dict(speeds), permit)

    @final
    def stop(self) -> None:
        """Halt every axis and hold it; this also ends a trajectory.

        Any thread may call this at any time. The stop never waits and is not queued. Earlier
        requests no longer pass the gate, even if the driver is closed.
        """
        self.gate.stop()
        self.halt()

    @final
    def halt(self) -> None:
        """Stop the device as :meth:`stop` does, for a caller that has already closed the gate."""
        if self._is_open:
            self._stop()

    @final
    def clear_fault(self, *, permit: Permit | None = None) -> None:
        """Acknowledge a fault; the device holds its position. Has no effect without a fault.

        Raises
        ------
        StateError
            If the device is closed.
        GateError
            See :meth:`move_to`.
        DriverError
            If the fault persists.
        """
        permit = self._require_permit(permit, PermitPurpose.SERVICE)
        self._require_open("clear a fault")
        if self._status().state is DeviceState.FAULT:
            self._clear_fault(permit)

    @final
    def read(self) -> DeviceSamples:
        """Return the samples since the last read; does not wait for more.

        Raises
        ------
        StateError
            If the device is closed.
        DriverError
            If the device does not answer, or its answer is invalid.
        """
        self._require_open("read")
        samples = self._read()
        if samples.command.shape[1] != len(self.axes):
            count = samples.command.shape[1]
            raise ProtocolError(
                "{name}: samples of {count} axes, expected {axes}",
                name=self.name,
                count=count,
                axes=len(self.axes),
            )
        if len(samples):
            if samples.device_time_s[0] <= self._last_time_s:
                raise ProtocolError(
                    "{name}: the device time went back from {last_time_s} s to "
                    "{device_time_s} s; check whether the device was reset",
                    name=self.name,
                    last_time_s=format_rounded(self._last_time_s, 9),
                    device_time_s=format_rounded(samples.device_time_s[0], 9),
                )
            self._last_time_s = float(samples.device_time_s[-1])
        return samples

    def _require_permit(
        self, permit: Permit | None, purpose: PermitPurpose = PermitPurpose.MOTION
    ) -> Permit:
        """Return the permit of a request, or a new one; raise if it is no longer valid."""
        permit = self.gate.permit(purpose) if permit is None else permit
        permit.check()
        return permit

    def _require_open(self, action: str) -> None:
        if not self._is_open:
            raise StateError(
                "{name}: cannot {action} while closed; open it first", name=self.name, action=action
            )

    def _require_operational(self, action: str) -> DeviceState:
        self._require_open(action)
        status = self._status()
        if status.silent_s > 0.0:
            raise StateError(
                "{name}: cannot {action}: the device has been silent for {silent} s; "
                "wait until it answers",
                name=self.name,
                action=action,
                silent=format_rounded(status.silent_s, 2),
            )
        if status.state is DeviceState.FAULT:
            raise StateError(
                "{name}: cannot {action} during a fault ({fault}); clear it",
                name=self.name,
                action=action,
                fault=status.fault or "",
            )
        if not status.position_known:
            template = message(
                "engine", "{name}: cannot {action} while the position is unknown; home first"
            )
            if status.unhomed:
                template = message(
                    "engine",
                    "{name}: cannot {action} while the position of {axes} is unknown; home first",
                )
            axes = ", ".join(status.unhomed)
            raise StateError(template.fill(name=self.name, action=action, axes=axes))
        return status.state

    def _require_not_busy(self, action: str) -> None:
        """Raise if a trajectory, a profile or a homing is running."""
        state = self._require_operational(action)
        if state in (DeviceState.PLAYING, DeviceState.HOMING):
            raise StateError(
                "{name}: cannot {action} while it is {state}; stop it first",
                name=self.name,
                action=action,
                state=state,
            )

    @abstractmethod
    def _open(self) -> None:
        """Connect; on failure leave nothing open."""

    @abstractmethod
    def _close(self) -> None:
        """Disconnect; the device holds its position."""

    def _identify(self) -> MachineKind:
        """Return the machine kind that the device reported while it was opened; sends nothing.

        A device counts as virtual only if all its parts report this in undamaged messages.
        """
        return self.built_in_kind or MachineKind.REAL

    @abstractmethod
    def _status(self) -> DeviceStatus:
        """Return the state of an open device without communicating with it."""

    @abstractmethod
    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        """Start moving to targets that are within all limits, no faster than ``speeds``.

        Write to the device only inside ``with permit.passing():``.
        """

    @abstractmethod
    def _stop(self) -> None:
        """Halt at once, from any thread, ahead of all queued output, without waiting.

        Another thread may be closing the device at the same time.
        """

    @abstractmethod
    def _clear_fault(self, permit: Permit) -> None:
        pass

    @abstractmethod
    def _read(self) -> DeviceSamples:
        """Return the samples since the last read."""
