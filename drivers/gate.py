"""The gate before a device: it blocks everything requested before the latest stop.

A request draws a :class:`Permit` before its first check. The permit goes with the request to the
last place before the device, the write of a frame or the change of a simulated target. There it is
compared with the gate under one lock, which a stop takes too: either the write comes before the
stop, which then halts it, or it does not come at all.
"""

import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import NamedTuple

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import StateError
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message


class GateError(StateError, InputError):
    """A request that the gate does not let through; nothing was sent to the device."""


class OvertakenError(GateError):
    """A request that came too late: after a stop, a release, a connection, or its lease's end."""


class Epoch(NamedTuple):
    """How many stops, connections and releases there have been."""

    stops: int = 0
    connections: int = 0
    releases: int = 0


class Purpose(StrEnum):
    """What a permit is for; each purpose is locked by other things."""

    MOTION = "motion"
    HOMING = "homing"
    SERVICE = "service"  # changes the device: a cleared fault, parameters, effects, a tool
    ENQUIRY = "enquiry"  # moves and switches on nothing


#: Why what a permit is for cannot be now, or None; it is called under the gate's lock, and so
#: neither waits nor takes another lock.
Locks = Callable[["Permit"], str | None]


class Gate:
    """What every write to a device passes.

    Parameters
    ----------
    clock : callable
        The host's time, s.
    locks : callable, optional
        What else locks a device; asked where something begins.
    """

    def __init__(self, clock: Clock = time.monotonic, locks: Locks = lambda _: None) -> None:
        self.clock = clock
        self.locks = locks
        # Held for a comparison and one write that cannot block; never for anything longer.
        self._lock = threading.Lock()
        self._epoch = Epoch()
        self._latched: str | None = None

    @property
    def epoch(self) -> Epoch:
        """What has happened so far; any thread."""
        return self._epoch

    @property
    def latched(self) -> str | None:
        """Why nothing moves until :meth:`release`; None while the gate is not latched."""
        return self._latched

    def permit(self, purpose: Purpose = Purpose.MOTION) -> "Permit":
        """Return a permit of this moment; any thread, never refused."""
        return Permit(self, self._epoch, purpose)

    def stop(self, latch: str | None = None) -> None:
        """Let nothing through that was requested before; with ``latch`` nothing at all."""
        with self._lock:
            if latch is not None:
                self._latched = latch
            self._epoch = self._epoch._replace(stops=self._epoch.stops + 1)

    def release(self) -> None:
        """End a latch; earlier requests remain blocked."""
        with self._lock:
            self._latched = None
            self._epoch = self._epoch._replace(releases=self._epoch.releases + 1)

    def reconnected(self) -> None:
        """Let nothing through that was asked of the connection before."""
        with self._lock:
            self._epoch = self._epoch._replace(connections=self._epoch.connections + 1)

    @contextmanager
    def passing(self, permit: "Permit", *, begins: bool) -> Iterator[None]:
        """Hold the gate open for one write of a permit's; see :meth:`Permit.passing`."""
        with self._lock:
            self._compare(permit, begins=begins)
            yield

    def _compare(self, permit: "Permit", *, begins: bool) -> None:
        """Refuse a permit that does not pass now; the lock is held."""
        if permit.epoch.connections != self._epoch.connections:
            raise OvertakenError(message("engine", "the connection has changed; try again"))
        if permit.purpose is Purpose.ENQUIRY:
            return
        if self._latched is not None:
            raise OvertakenError(
                message("engine", "{stop} is active; release it first").fill(stop=self._latched)
            )
        if permit.epoch != self._epoch:
            raise OvertakenError(message("engine", "a stop came after this request; try again"))
        if self.clock() > permit.until_s:
            raise OvertakenError(
                message("engine", "the lease of the request has expired; try again")
            )
        why = self.locks(permit) if begins else None
        if why is not None:
            raise GateError(message("engine", "motion is locked: {locked}").fill(locked=why))


@dataclass(frozen=True, slots=True)
class Permit:
    """The right to send something to a device, as long as nothing has come in between.

    Attributes
    ----------
    gate : Gate
    epoch : Epoch
        What had happened when it was drawn.
    purpose : Purpose
    owner : str or None
        Who drives ``axes``; None where nobody is asked.
    axes : frozenset of str
    until_s : float
        Host time after which it is worth nothing: the end of a lease.
    """

    gate: Gate
    epoch: Epoch
    purpose: Purpose = Purpose.MOTION
    owner: str | None = None
    axes: frozenset[str] = frozenset()
    until_s: float = float("inf")

    @property
    def valid(self) -> bool:
        """Whether no stop, release or connection has come since; any thread, asks no lock."""
        return self.epoch == self.gate.epoch and self.gate.latched is None

    def check(self) -> None:
        """Refuse what would not pass the gate now.

        Raises
        ------
        GateError
            With the reason.
        """
        with self.passing():
            pass

    @contextmanager
    def passing(self, *, begins: bool = True) -> Iterator[None]:
        """Hold the gate open for one write that cannot block.

        ``begins`` is False where a motion continues that has begun, a playback's next set-point:
        then stop, latch and connection count, and nothing else.

        Raises
        ------
        GateError
            With the reason; then nothing may be written.
        """
        with self.gate.passing(self, begins=begins):
            yield

    def owned(self, axes: Iterable[str], owner: str) -> "Permit":
        """Return the permit for axes that ``owner`` is to drive when it passes."""
        return replace(self, axes=frozenset(axes), owner=owner)

    def until(self, host_time_s: float) -> "Permit":
        """Return the permit with an end."""
        return replace(self, until_s=host_time_s)

    def meant_for(self, purpose: Purpose) -> "Permit":
        """Return the permit, drawn at the same moment, for something else."""
        return replace(self, purpose=purpose)
