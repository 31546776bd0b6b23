"""The gate in front of a device, which blocks all requests from before the latest stop.

A request draws a :class:`Permit` before its first check. The permit is passed with the request to
the last step before the device: the write of a frame, or the change of a simulated target. There it
is compared with the gate, under a lock that a stop also takes. So either the write precedes the
stop, which then halts the motion, or the write does not happen.
"""

import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

from rotemina.drivers.contract.errors import GateError, StalePermitError
from rotemina.sim.compatibility import FormerMember, serve_former_names


class GateEpoch(NamedTuple):
    """Numbers of stops, connections and releases up to now."""

    stops: int = 0
    connections: int = 0
    releases: int = 0


class PermitPurpose(StrEnum):
    """The purpose of a permit; each purpose has its own locks."""

    MOTION = "motion"
    HOMING = "homing"
    #: Changes to the device: clear a fault, write parameters, set effects, switch a tool on.
    SERVICE = "service"
    #: Requests that move nothing and switch nothing on.
    ENQUIRY = "enquiry"


#: Returns why motion under a permit is locked now, or None. It is called under the gate's lock, so
#: it must not wait or take another lock.
LockReason = Callable[["Permit"], str | None]


class Gate:
    """The gate of one device, which every write to the device must pass.

    Parameters
    ----------
    clock : callable
        Returns the host's time, s.
    lock_reason : callable, optional
        Checks additional locks of the device, such as an interlock; called when a motion begins.
    """

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, lock_reason: LockReason = lambda _: None
    ) -> None:
        self.clock = clock
        self.lock_reason = lock_reason
        # Held only for a comparison and for one write that does not block.
        self._lock = threading.Lock()
        self._epoch = GateEpoch()
        self._latch_reason: str | None = None

    @property
    def epoch(self) -> GateEpoch:
        """The current epoch; may be read on any thread."""
        return self._epoch

    @property
    def latch_reason(self) -> str | None:
        """Why nothing may move until :meth:`release`; None if no stop is latched."""
        return self._latch_reason

    def permit(self, purpose: PermitPurpose = PermitPurpose.MOTION) -> "Permit":
        """Return a permit of the current epoch; any thread may call this, and always gets one."""
        return Permit(self, self._epoch, purpose)

    def stop(self, latch: str | None = None) -> None:
        """Block all earlier requests; if ``latch`` is a reason, also block all later requests."""
        with self._lock:
            if latch is not None:
                self._latch_reason = latch
            self._epoch = self._epoch._replace(stops=self._epoch.stops + 1)

    def release(self) -> None:
        """Release a latched stop; earlier requests remain blocked."""
        with self._lock:
            self._latch_reason = None
            self._epoch = self._epoch._replace(releases=self._epoch.releases + 1)

    def start_connection(self) -> None:
        """Block all requests from before the new connection."""
        with self._lock:
            self._epoch = self._epoch._replace(connections=self._epoch.connections + 1)

    @contextmanager
    def passing(self, permit: "Permit", *, begins: bool) -> Iterator[None]:
        """Hold the gate open for one write under a permit; see :meth:`Permit.passing`."""
        with self._lock:
            self._check_permit(permit, begins=begins)
            yield

    def _check_permit(self, permit: "Permit", *, begins: bool) -> None:
        """Raise if a permit does not pass the gate now; the caller holds the lock."""
        if permit.epoch.connections != self._epoch.connections:
            raise StalePermitError("the connection has changed; try again")
        if permit.purpose is PermitPurpose.ENQUIRY:
            return
        if self._latch_reason is not None:
            raise StalePermitError("{stop} is active; release it first", stop=self._latch_reason)
        if permit.epoch != self._epoch:
            raise StalePermitError("a stop came after this request; try again")
        if self.clock() > permit.until_s:
            raise StalePermitError("the lease of the request has expired; try again")
        reason = self.lock_reason(permit) if begins else None
        if reason is not None:
            raise GateError("motion is locked: {locked}", locked=reason)

    # Former names, which work for one more release.
    latched = FormerMember("latch_reason")
    locks = FormerMember("lock_reason")
    reconnected = FormerMember("start_connection")


@dataclass(frozen=True, slots=True)
class Permit:
    """The right to send something to a device until the next stop, release or connection.

    Attributes
    ----------
    gate : Gate
    epoch : GateEpoch
        Epoch in which the permit was drawn.
    purpose : PermitPurpose
    owner : str or None
        The owner that must hold ``axes``; None if the ownership is not checked.
    axes : frozenset of str
    until_s : float
        Host time at which the permit expires, such as the end of a lease.
    """

    gate: Gate
    epoch: GateEpoch
    purpose: PermitPurpose = PermitPurpose.MOTION
    owner: str | None = None
    axes: frozenset[str] = frozenset()
    until_s: float = float("inf")

    @property
    def is_valid(self) -> bool:
        """Whether no stop, release or connection has followed; for any thread, takes no lock."""
        return self.epoch == self.gate.epoch and self.gate.latch_reason is None

    def check(self) -> None:
        """Check that the permit would pass the gate now.

        Raises
        ------
        GateError
            If it would not; the message gives the reason.
        """
        with self.passing():
            pass

    @contextmanager
    def passing(self, *, begins: bool = True) -> Iterator[None]:
        """Hold the gate open for one write that cannot block.

        ``begins`` is False if the write continues a motion, such as the next set-point of a
        playback. Then the locks of :attr:`Gate.lock_reason` are not checked.

        Raises
        ------
        GateError
            If the permit does not pass; the message gives the reason. Then nothing may be written.
        """
        with self.gate.passing(self, begins=begins):
            yield

    def with_owner(self, axes: Iterable[str], owner: str) -> "Permit":
        """Return a copy that passes only while ``owner`` may move these axes."""
        return replace(self, axes=frozenset(axes), owner=owner)

    def with_deadline(self, host_time_s: float) -> "Permit":
        """Return a copy that expires at a host time."""
        return replace(self, until_s=host_time_s)

    def with_purpose(self, purpose: PermitPurpose) -> "Permit":
        """Return a copy of the same epoch with another purpose."""
        return replace(self, purpose=purpose)

    # Former names, which work for one more release.
    meant_for = FormerMember("with_purpose")
    owned = FormerMember("with_owner")
    until = FormerMember("with_deadline")
    valid = FormerMember("is_valid")


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Epoch="GateEpoch",
        Locks="LockReason",
        OvertakenError="rotemina.drivers.contract.errors.StalePermitError",
        Purpose="PermitPurpose",
    )
