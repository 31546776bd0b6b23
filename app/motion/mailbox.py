"""What other threads leave for the worker: a short queue of commands, and a bell."""

import threading
from collections import deque
from dataclasses import dataclass
from typing import NamedTuple

from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record


class RefusedError(InputError):
    """A command that the session does not take now; the message says why and what to do."""


@dataclass(frozen=True, slots=True)
class Move:
    """Send axes to positions, m or rad."""

    targets: dict[str, float]


@dataclass(frozen=True, slots=True)
class Play:
    """Play a trajectory."""

    trajectory: Record


@dataclass(frozen=True, slots=True)
class ClearFault:
    """Acknowledge the device's fault."""


Command = Move | Play | ClearFault


class Taken(NamedTuple):
    """A command, and how many times the queue had been emptied by a stop before it was taken."""

    command: Command
    generation: int


class Mailbox:
    """A bounded queue; every method may be called from any thread and returns at once."""

    def __init__(self, capacity: int) -> None:
        self.capacity = capacity
        self.bell = threading.Event()
        self._commands: deque[Command] = deque()
        self._generation = 0
        self._connect = False
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._commands)

    @property
    def generation(self) -> int:
        """How many times the queue has been emptied."""
        return self._generation

    def post(self, command: Command) -> None:
        """Queue a command and ring.

        Raises
        ------
        RefusedError
            If the queue is full.
        """
        with self._lock:
            if len(self._commands) >= self.capacity:
                raise RefusedError(
                    f"{self.capacity} commands are waiting already and the device does not keep "
                    "up; wait, or stop"
                )
            self._commands.append(command)
        self.bell.set()

    def take(self) -> Taken | None:
        """Return the oldest command, or None."""
        with self._lock:
            if not self._commands:
                return None
            return Taken(self._commands.popleft(), self._generation)

    def clear(self) -> None:
        """Drop every command, and mark those already taken as overtaken."""
        with self._lock:
            self._commands.clear()
            self._generation += 1

    def holds_play(self) -> bool:
        """Whether a trajectory waits to be played."""
        with self._lock:
            return any(isinstance(command, Play) for command in self._commands)

    def request_connection(self) -> None:
        """Ask the worker to open the device, and ring."""
        self._connect = True
        self.bell.set()

    def take_connection_request(self) -> bool:
        """Return whether the device is to be opened now."""
        wanted, self._connect = self._connect, False
        return wanted
