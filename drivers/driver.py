"""The driver contract: the base class enforces the rules, a driver fills small hooks.

A driver is made without touching its device, opened, used by one thread, and closed. ``stop`` is
the exception: any thread may call it at any time. What only some devices can do is a small base
class of its own (:mod:`rotemina.drivers.abilities`), to be inherited beside others.

Whatever moves something passes the driver's gate (:mod:`rotemina.drivers.gate`) at its last place
before the device: hooks get a permit, and write inside ``with permit.passing():``.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Mapping
from contextlib import suppress
from enum import StrEnum
from types import MappingProxyType
from typing import ClassVar, final

from rotemina.drivers.axes import AxisDescription
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import LimitError, ProtocolError, StateError
from rotemina.drivers.gate import Gate, Permit, Purpose
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.drivers.settings import SettingValue, resolve
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.plugin_points import API_VERSIONS
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import check_speeds, check_target

_CLOSED = DeviceStatus(DeviceState.CLOSED)


class MachineKind(StrEnum):
    """What moves when a device is commanded."""

    REAL = "real"
    #: A program behaves like the device, byte for byte, at the other end of a line.
    VIRTUAL = "virtual"
    #: The driver itself computes the machine; there is no device.
    SIMULATED = "simulated"


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

    #: The version of this interface that the class was written for.
    api_version: ClassVar[int] = API_VERSIONS["rotemina.drivers"]
    #: How screens and records call the device.
    name: ClassVar[str] = "device"
    #: Whether the device lives on ``clock`` alone, and so can run faster than real time.
    virtual_time: ClassVar[bool] = False
    #: How often the driver wants to be read, s; one that feeds a serial line has no other chance.
    service_period_s: ClassVar[float] = 0.01
    #: By how much the time of a sample may be wrong where the device has no clock of its own, s.
    stamp_error_s: float = 0.0
    default_settings: ClassVar[Mapping[str, SettingValue]] = MappingProxyType({})
    #: What the device is before it was opened; only a driver without a device knows.
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
        self.settings = MappingProxyType(resolve(self.default_settings, settings or {}, self.name))
        self.clock = clock
        #: What every motion passes; a program that owns the driver puts its own gate here.
        self.gate = Gate(clock)
        self._is_open = False
        self._machine_kind = self.built_in_kind
        self._last_time_s = float("-inf")

    def __init_subclass__(cls) -> None:
        """Refuse a subclass that overrides a rule of the contract instead of a hook."""
        super().__init_subclass__()
        for base in cls.__mro__[1:]:
            for name, member in vars(base).items():
                # Compared as found: a class mixed in from elsewhere must not override either.
                rule = member.fget if isinstance(member, property) else member
                if getattr(rule, "__final__", False) and getattr(cls, name) is not member:
                    raise TypeError(
                        f"{cls.__name__}.{name}: final in {base.__name__}; fill _{name}"
                    )

    @final
    def open(self) -> None:
        """Connect to the device, which holds its position.

        Raises
        ------
        StateError
            If it is open already.
        DriverError
            If the device cannot be reached or is not the one expected.
        """
        if self._is_open:
            raise StateError(
                message("engine", "{name} is already open; close it first").fill(name=self.name)
            )
        self._last_time_s = float("-inf")
        self._open()
        try:
            self._machine_kind = MachineKind(self._identify())
        except BaseException:
            with suppress(Exception):  # the first failure is the one to report
                self._close()
            raise
        self._is_open = True

    @final
    def close(self) -> None:
        """Release the device; safe to call twice. It counts as closed even if this raises."""
        if not self._is_open:
            return
        self._is_open = False
        self._close()

    @property
    @final
    def machine_kind(self) -> MachineKind:
        """What moves when the device is commanded, as it said when it was opened last; any thread.

        It stays after the device was closed or lost. Unless a device says otherwise it is real.
        """
        return self._machine_kind or MachineKind.REAL

    @property
    @final
    def is_identified(self) -> bool:
        """Whether :attr:`machine_kind` is known, rather than assumed; any thread."""
        return self._machine_kind is not None

    @property
    def stop_pending(self) -> bool:
        """Whether the device has not yet confirmed a stop; without reports it confirms at once."""
        return False

    @property
    def descriptions(self) -> tuple[AxisDescription, ...]:
        """What the axes are, in order; a driver that knows its device better says so."""
        return tuple(AxisDescription.of(self.robot, axis) for axis in self.axes)

    @final
    def status(self) -> DeviceStatus:
        """Return the device's state as of the last exchange with it; asks nothing, never waits."""
        return self._status() if self._is_open else _CLOSED

    @final
    def move_to(
        self,
        targets: Mapping[str, float],
        speeds: Mapping[str, float] = MappingProxyType({}),
        *,
        permit: Permit | None = None,
    ) -> None:
        """Begin to move axes to positions (m or rad); also in mid-move. Returns at once.

        Each goes as fast as it may, or as ``speeds`` (m/s or rad/s) says, where that is slower.
        ``permit`` is that of the request; drawn now where it is left out.

        Raises
        ------
        LimitError
            If any target is beyond a limit, or a speed is none; then no axis moves.
        StateError
            If the device is closed, faulty or playing a trajectory.
        GateError
            If a stop has come since the permit was drawn, or something locks motion.
        """
        permit = self._permitted(permit)
        self._require_free("move")
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
        """Bring every axis to a halt and hold it there; ends a trajectory too.

        Any thread may call it at any time. It never waits and is not queued behind anything. What
        was requested before does not pass the gate any more, on a closed driver too.
        """
        self.gate.stop()
        self.halt()

    @final
    def halt(self) -> None:
        """Stop the device after the gate has been closed; as :meth:`stop`."""
        if self._is_open:
            self._stop()

    @final
    def clear_fault(self, *, permit: Permit | None = None) -> None:
        """Acknowledge a fault: the device holds its position. No effect without a fault.

        Raises
        ------
        StateError
            If the device is closed.
        GateError
            As :meth:`move_to`.
        DriverError
            If the fault persists.
        """
        permit = self._permitted(permit, Purpose.SERVICE)
        self._require_open("clear a fault")
        if self._status().state is DeviceState.FAULT:
            self._clear_fault(permit)

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
            raise ProtocolError(
                message("engine", "{name}: samples of {count} axes, expected {axes}").fill(
                    name=self.name, count=count, axes=len(self.axes)
                )
            )
        if len(samples):
            if samples.device_time_s[0] <= self._last_time_s:
                raise ProtocolError(
                    message(
                        "engine",
                        "{name}: the device time went back from {last_time_s} s to "
                        "{device_time_s} s; check whether the device was reset",
                    ).fill(
                        name=self.name,
                        last_time_s=rounded(self._last_time_s, 9),
                        device_time_s=rounded(samples.device_time_s[0], 9),
                    )
                )
            self._last_time_s = float(samples.device_time_s[-1])
        return samples

    def _permitted(self, permit: Permit | None, purpose: Purpose = Purpose.MOTION) -> Permit:
        """Return the permit of a request, which still holds; one of now where there is none."""
        permit = self.gate.permit(purpose) if permit is None else permit
        permit.check()
        return permit

    def _require_open(self, action: str) -> None:
        if not self._is_open:
            raise StateError(
                message("engine", "{name}: cannot {action} while closed; open it first").fill(
                    name=self.name, action=action
                )
            )

    def _require_sound(self, action: str) -> DeviceState:
        self._require_open(action)
        status = self._status()
        if status.silent_s > 0.0:
            raise StateError(
                message(
                    "engine",
                    "{name}: cannot {action}: the device has been silent for {silent} s; "
                    "wait until it answers",
                ).fill(name=self.name, action=action, silent=rounded(status.silent_s, 2))
            )
        if status.state is DeviceState.FAULT:
            raise StateError(
                message(
                    "engine", "{name}: cannot {action} during a fault ({fault}); clear it"
                ).fill(name=self.name, action=action, fault=status.fault or "")
            )
        if not status.position_known:
            unknown = message(
                "engine", "{name}: cannot {action} while the position is unknown; home first"
            )
            if status.unhomed:
                unknown = message(
                    "engine",
                    "{name}: cannot {action} while the position of {axes} is unknown; home first",
                )
            axes = ", ".join(status.unhomed)
            raise StateError(unknown.fill(name=self.name, action=action, axes=axes))
        return status.state

    def _require_free(self, action: str) -> None:
        """Refuse what would break into a trajectory, a profile or a search for switches."""
        state = self._require_sound(action)
        if state in (DeviceState.PLAYING, DeviceState.HOMING):
            raise StateError(
                message(
                    "engine", "{name}: cannot {action} while it is {state}; stop it first"
                ).fill(name=self.name, action=action, state=state)
            )

    @abstractmethod
    def _open(self) -> None:
        """Connect; on failure leave nothing open behind."""

    @abstractmethod
    def _close(self) -> None:
        """Disconnect; the device holds."""

    def _identify(self) -> MachineKind:
        """Return what the device has said of itself while it was opened; asks nothing.

        A device is virtual only if all of it has said so in messages that arrived undamaged.
        """
        return self.built_in_kind or MachineKind.REAL

    @abstractmethod
    def _status(self) -> DeviceStatus:
        """Return what is known of an open device without asking it."""

    @abstractmethod
    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        """Begin to move to targets that are inside every limit, no faster than ``speeds``.

        What is written to the device is written inside ``with permit.passing():``.
        """

    @abstractmethod
    def _stop(self) -> None:
        """Halt, from any thread, out of band, without waiting; the device is or was just open."""

    @abstractmethod
    def _clear_fault(self, permit: Permit) -> None:
        """Acknowledge the present fault."""

    @abstractmethod
    def _read(self) -> Samples:
        """Return the samples since the last read."""
