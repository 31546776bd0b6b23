"""Requests of other threads to the worker: a short command queue and a wake event."""

import threading
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

from rotemina.app.motion.guard import PathSegment
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import GateError, Permit
from rotemina.drivers.profile import Profile
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.errors import InputError
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.messages import Message, message
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory

A = TypeVar("A")


class RefusedError(InputError):
    """A refused command; the message gives reason and remedy."""


def able(driver: Driver, ability: type[A], refusal: Message) -> A:
    """Return a driver that has an ability.

    Raises
    ------
    RefusedError
        With the ``refusal`` and in it the driver's ``name``, if it has not.
    """
    if not isinstance(driver, ability):
        raise RefusedError(refusal.fill(name=repr(driver.name)))
    return driver


def refuse_overtaken(permit: Permit) -> None:
    """Raise :class:`RefusedError` where a permit would not pass the gate now."""
    try:
        permit.check()
    except GateError as error:
        raise RefusedError(str(error)) from error


@dataclass(frozen=True, slots=True)
class Move:
    """Send axes to positions, m or rad, segment after segment."""

    segments: tuple[PathSegment, ...]

    @property
    def targets(self) -> dict[str, float]:
        """Where each axis ends."""
        return {axis: at for segment in self.segments for axis, at in segment.targets.items()}


@dataclass(frozen=True, slots=True)
class Drive:
    """Move axes at speeds, m/s or rad/s, until the lease runs out.

    ``asked_s`` is the host's time of the request: a lease does not restart in a queue. ``ways`` is
    how far each axis moves at most without renewal, ``braking`` how far after an immediate stop; m
    or rad, with sign.
    """

    velocities: dict[str, float]
    lease_s: float
    asked_s: float
    ways: dict[str, float]
    braking: dict[str, float]


@dataclass(frozen=True, slots=True)
class Home:
    """Find the limit switches of axes."""

    axes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Ask:
    """Another request to the driver, executed on the thread that talks to it."""

    action: Callable[[Driver, Permit], None]


@dataclass(frozen=True, slots=True)
class Play:
    """Play a trajectory; ``sent`` is the version for the device, if that differs.

    Without ``shown`` it is a way to somewhere, whose record nobody wants.
    """

    trajectory: CheckedTrajectory
    sent: CheckedTrajectory | None = None
    compensations: Mapping[str, str] = field(default_factory=dict)
    loops: Mapping[str, str] = field(default_factory=dict)
    shown: bool = True


@dataclass(frozen=True, slots=True)
class LoadProfile:
    """Upload a profile without running it."""

    profile: Profile


@dataclass(frozen=True, slots=True)
class RunProfile:
    """Run the uploaded profile; its axis ends at ``targets``, m or rad."""

    targets: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class SetVoltage:
    """Set a voltage, V, which sends its axis to ``targets``, m or rad."""

    axis: str
    voltage: float
    targets: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Compensate:
    """Send set-points of an axis through an inverse, or, for None, as they are."""

    axis: str
    model: InverseModel | None


@dataclass(frozen=True, slots=True)
class Regulate:
    """Close a loop around an axis, or, for None, open it."""

    axis: str
    regulation: Regulation | None


@dataclass(frozen=True, slots=True)
class ClearFault:
    """Acknowledge the device's fault."""


@dataclass(frozen=True, slots=True)
class SetEffects:
    """Put other effects on a simulated machine."""

    effects: tuple[AxisEffect, ...]


Command = (
    Move
    | Drive
    | Play
    | Home
    | LoadProfile
    | RunProfile
    | SetVoltage
    | ClearFault
    | SetEffects
    | Compensate
    | Regulate
    | Ask
)


class ConnectionRequest:
    """The desired connection: a ``driver``, or None to disconnect. Who claims it does it."""

    def __init__(self, driver: Driver | None) -> None:
        self.driver = driver
        self._lock = threading.Lock()
        self._is_claimed = False

    def claim(self) -> bool:
        """Return whether nobody has claimed it before; any thread."""
        with self._lock:
            is_first = not self._is_claimed
            self._is_claimed = True
        return is_first


class Posted(NamedTuple):
    """A command, and the permit that was drawn before it was first checked."""

    command: Command
    permit: Permit


class Mailbox:
    """A bounded queue; every method may be called from any thread and returns at once."""

    def __init__(self, capacity: int) -> None:
        self.capacity = capacity
        self.wake_event = threading.Event()
        self._commands: deque[Posted] = deque()
        self._in_hand: Posted | None = None
        self._dropped_plays: list[Play] = []
        self._connection_request: ConnectionRequest | None = None
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._commands)

    @property
    def busy(self) -> bool:
        """Whether a command is queued or being executed."""
        with self._lock:
            return bool(self._commands) or self._in_hand is not None

    def post(self, command: Command, permit: Permit) -> None:
        """Queue a command and wake the worker.

        Raises
        ------
        RefusedError
            If its permit would not pass the gate now, or the queue is full.
        """
        refuse_overtaken(permit)
        with self._lock:
            if isinstance(command, Drive) and self._renews(command):
                self._commands.pop()
            if len(self._commands) >= self.capacity:
                raise RefusedError(
                    message(
                        "engine",
                        "{capacity} commands are already waiting because the device does not "
                        "keep up; wait, or stop",
                    ).fill(capacity=self.capacity)
                )
            self._commands.append(Posted(command, permit))
        self.wake_event.set()

    def _renews(self, command: Drive) -> bool:
        """Return whether the latest command is of the same axes: only the newest speed counts."""
        latest = self._commands[-1].command if self._commands else None
        return isinstance(latest, Drive) and latest.velocities.keys() <= command.velocities.keys()

    def take(self) -> Posted | None:
        """Return the oldest command, or None; the one taken before counts as done."""
        with self._lock:
            self._in_hand = self._commands.popleft() if self._commands else None
            return self._in_hand

    def clear(self) -> None:
        """Drop every command."""
        with self._lock:
            dropped = (posted.command for posted in self._commands)
            self._dropped_plays += [each for each in dropped if isinstance(each, Play)]
            self._commands.clear()
            self._in_hand = None

    def take_dropped_plays(self) -> list[Play]:
        """Return the trajectories that were dropped since the last call, before they began."""
        with self._lock:
            dropped, self._dropped_plays = self._dropped_plays, []
        return dropped

    def holds_play(self) -> bool:
        """Whether a trajectory waits to be played, or a profile to be run."""
        with self._lock:
            return any(isinstance(one.command, Play | RunProfile) for one in self._commands)

    def pending(self) -> list[Mapping[str, float]]:
        """Return the targets of all queued or executing moves, oldest first."""
        found: list[Mapping[str, float]] = []
        for command in self._unfinished():
            if isinstance(command, Move):
                found += [segment.targets for segment in command.segments]
            elif isinstance(command, RunProfile | SetVoltage):
                found.append(command.targets)
        return found

    def drives(self) -> list[Drive]:
        """Return the queued or executing speeds, oldest first."""
        return [command for command in self._unfinished() if isinstance(command, Drive)]

    def _unfinished(self) -> list[Command]:
        with self._lock:
            posted = [self._in_hand, *self._commands]
        return [one.command for one in posted if one is not None]

    def request_connection(self, request: ConnectionRequest) -> None:
        """Ask the worker to connect or disconnect, and wake it; the latest request counts."""
        with self._lock:
            before, self._connection_request = self._connection_request, request
        if before is not None:
            before.claim()  # nobody does it any more
        self.wake_event.set()

    def repeat_connection_request(self, request: ConnectionRequest) -> None:
        """Ask again for a connection that was claimed and not made, unless a newer one waits."""
        with self._lock:
            if self._connection_request in (None, request):
                self._connection_request = ConnectionRequest(request.driver)

    def take_connection_request(self) -> ConnectionRequest | None:
        """Return the pending change of the connection, if any."""
        with self._lock:
            request, self._connection_request = self._connection_request, None
        return request
