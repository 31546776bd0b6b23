"""Requests of other threads to the worker: commands, a short queue, and a wake event."""

import threading
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.limits import PathSegment
from rotemina.drivers.abilities import MotionProfile
from rotemina.drivers.contract import Driver, GateError, Permit
from rotemina.sim.compensate import InverseModel
from rotemina.sim.feedback import AxisRegulation
from rotemina.sim.messages import Message
from rotemina.sim.robot import AxisEffect
from rotemina.sim.trajectory import CheckedTrajectory

AbilityT = TypeVar("AbilityT")


def require_ability(driver: Driver, ability: type[AbilityT], refusal: Message) -> AbilityT:
    """Return the driver if it has an ability.

    Raises
    ------
    RequestRefusedError
        If the driver lacks the ability. The message is ``refusal`` with the driver's ``name``.
    """
    if not isinstance(driver, ability):
        raise RequestRefusedError(refusal.fill(name=repr(driver.name)))
    return driver


def refuse_invalidated_permit(permit: Permit) -> None:
    """Refuse a request whose permit a stop has invalidated.

    Raises
    ------
    RequestRefusedError
        If the permit would not pass the gate now.
    """
    try:
        permit.check()
    except GateError as error:
        raise RequestRefusedError(str(error)) from error


@dataclass(frozen=True, slots=True)
class MoveCommand:
    """Move axes to positions, m or rad, segment after segment."""

    segments: tuple[PathSegment, ...]

    @property
    def targets(self) -> dict[str, float]:
        """The final target of each axis."""
        return {axis: end for segment in self.segments for axis, end in segment.targets.items()}


@dataclass(frozen=True, slots=True)
class VelocityCommand:
    """Move axes at speeds, m/s or rad/s, until the lease runs out.

    Attributes
    ----------
    velocities : dict axis -> float
    lease_s : float
    requested_s : float
        Host time of the request. The lease runs from then on, also while the command is queued.
    travels : dict axis -> float
        Largest displacement of each axis without renewal, m or rad, with sign.
    braking_travels : dict axis -> float
        Displacement of each axis after an immediate stop, m or rad, with sign.
    """

    velocities: dict[str, float]
    lease_s: float
    requested_s: float
    travels: dict[str, float]
    braking_travels: dict[str, float]


@dataclass(frozen=True, slots=True)
class HomeCommand:
    """Find the limit switches of axes."""

    axes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DriverCallCommand:
    """Call a function with the driver, on the thread that calls the driver."""

    action: Callable[[Driver, Permit], None]


@dataclass(frozen=True, slots=True)
class PlayCommand:
    """Play a trajectory.

    ``sent`` holds the converted commands for the device, or None if the trajectory itself is sent.
    If ``shown`` is false, the playback only moves the machine somewhere, and its record is not
    kept.
    """

    trajectory: CheckedTrajectory
    converted: CheckedTrajectory | None = None
    compensations: Mapping[str, str] = field(default_factory=dict)
    loops: Mapping[str, str] = field(default_factory=dict)
    shown: bool = True


@dataclass(frozen=True, slots=True)
class LoadProfileCommand:
    """Upload a profile without running it."""

    profile: MotionProfile


@dataclass(frozen=True, slots=True)
class RunProfileCommand:
    """Run the uploaded profile; its axis ends at ``targets``, m or rad."""

    targets: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class VoltageCommand:
    """Set a voltage, V, which moves its axis to ``targets``, m or rad."""

    axis: str
    voltage: float
    targets: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class InverseCommand:
    """Convert the set-points of an axis with an inverse; with None they are sent unchanged."""

    axis: str
    model: InverseModel | None


@dataclass(frozen=True, slots=True)
class LoopCommand:
    """Close a feedback loop around an axis; None opens the loop."""

    axis: str
    regulation: AxisRegulation | None


@dataclass(frozen=True, slots=True)
class ClearFaultCommand:
    """Acknowledge the device's fault."""


@dataclass(frozen=True, slots=True)
class EffectsCommand:
    """Give a simulated machine other effects."""

    effects: tuple[AxisEffect, ...]


Command = (
    MoveCommand
    | VelocityCommand
    | PlayCommand
    | HomeCommand
    | LoadProfileCommand
    | RunProfileCommand
    | VoltageCommand
    | ClearFaultCommand
    | EffectsCommand
    | InverseCommand
    | LoopCommand
    | DriverCallCommand
)


class ConnectionRequest:
    """A request to connect ``driver``, or to disconnect if it is None.

    Two workers may see the same request. The one whose :meth:`claim` succeeds executes it.
    """

    def __init__(self, driver: Driver | None) -> None:
        self.driver = driver
        self._lock = threading.Lock()
        self._is_claimed = False

    def claim(self) -> bool:
        """Claim the request, and return whether nobody has claimed it before. Thread-safe."""
        with self._lock:
            is_first = not self._is_claimed
            self._is_claimed = True
        return is_first


class QueuedCommand(NamedTuple):
    """A command, and the permit that was taken before its first check."""

    command: Command
    permit: Permit


class Mailbox:
    """A bounded queue of commands; every method may be called from any thread, and never waits."""

    def __init__(self, capacity: int) -> None:
        self.capacity = capacity
        self.wake_event = threading.Event()
        self._commands: deque[QueuedCommand] = deque()
        self._current_command: QueuedCommand | None = None
        self._dropped_plays: list[PlayCommand] = []
        self._connection_request: ConnectionRequest | None = None
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._commands)

    @property
    def is_busy(self) -> bool:
        """Whether a command is queued or being executed."""
        with self._lock:
            return bool(self._commands) or self._current_command is not None

    def post(self, command: Command, permit: Permit) -> None:
        """Queue a command and wake the worker.

        Raises
        ------
        RequestRefusedError
            If its permit would not pass the gate now, or the queue is full.
        """
        refuse_invalidated_permit(permit)
        with self._lock:
            if isinstance(command, VelocityCommand) and self._is_renewal(command):
                self._commands.pop()
            if len(self._commands) >= self.capacity:
                raise RequestRefusedError(
                    "{capacity} commands are already waiting because the device does not "
                    "keep up; wait, or stop",
                    capacity=self.capacity,
                )
            self._commands.append(QueuedCommand(command, permit))
        self.wake_event.set()

    def _is_renewal(self, command: VelocityCommand) -> bool:
        """Return whether a speed command covers, and so replaces, the last queued one."""
        latest = self._commands[-1].command if self._commands else None
        return (
            isinstance(latest, VelocityCommand)
            and latest.velocities.keys() <= command.velocities.keys()
        )

    def take_command(self) -> QueuedCommand | None:
        """Return the oldest command, or None. The previously taken command is then finished."""
        with self._lock:
            self._current_command = self._commands.popleft() if self._commands else None
            return self._current_command

    def clear(self) -> None:
        """Drop all commands."""
        with self._lock:
            self._dropped_plays += [
                queued.command
                for queued in self._commands
                if isinstance(queued.command, PlayCommand)
            ]
            self._commands.clear()
            self._current_command = None

    def take_dropped_plays(self) -> list[PlayCommand]:
        """Return the playbacks that have been dropped from the queue since the last call."""
        with self._lock:
            dropped, self._dropped_plays = self._dropped_plays, []
        return dropped

    def has_waiting_play(self) -> bool:
        """Return whether a playback or the run of a profile is waiting."""
        with self._lock:
            return any(
                isinstance(queued.command, PlayCommand | RunProfileCommand)
                for queued in self._commands
            )

    def list_pending_targets(self) -> list[Mapping[str, float]]:
        """Return the targets of all queued or executing moves, oldest first."""
        targets: list[Mapping[str, float]] = []
        for command in self._list_unfinished():
            if isinstance(command, MoveCommand):
                targets += [segment.targets for segment in command.segments]
            elif isinstance(command, RunProfileCommand | VoltageCommand):
                targets.append(command.targets)
        return targets

    def list_velocity_commands(self) -> list[VelocityCommand]:
        """Return the queued or executing speed commands, oldest first."""
        return [
            command for command in self._list_unfinished() if isinstance(command, VelocityCommand)
        ]

    def _list_unfinished(self) -> list[Command]:
        with self._lock:
            unfinished = [self._current_command, *self._commands]
        return [queued.command for queued in unfinished if queued is not None]

    def request_connection(self, request: ConnectionRequest) -> None:
        """Ask the worker to connect or disconnect, and wake it. The latest request counts."""
        with self._lock:
            previous, self._connection_request = self._connection_request, request
        if previous is not None:
            # Claim the replaced request here, so that no worker executes it.
            previous.claim()
        self.wake_event.set()

    def repeat_connection_request(self, request: ConnectionRequest) -> None:
        """Repeat a request that a hung worker has not executed, unless a newer one is waiting."""
        with self._lock:
            if self._connection_request in (None, request):
                self._connection_request = ConnectionRequest(request.driver)

    def take_connection_request(self) -> ConnectionRequest | None:
        """Return and remove the pending connection request, if any."""
        with self._lock:
            request, self._connection_request = self._connection_request, None
        return request
