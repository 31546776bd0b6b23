"""Operator requests that wait until the machine rests or a dry run has ended.

Each request ends once: it is accepted, refused or withdrawn. Refusals and withdrawals are always
reported, so that no click is ignored silently.
"""

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, TypeVar

from rotemina.app.language import translate
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.app.workbench.operator_requests import OperatorRequests
from rotemina.drivers.contract import Clock, DeviceState, Permit
from rotemina.sim.compatibility import FormerMember, serve_former_names

# After this time the request is made anyway, and the session refuses it if the machine moves.
MAX_WAIT_S = 2.0

PendingItem = TypeVar("PendingItem")


class PendingConfirmation(Generic[PendingItem]):
    """One item that waits until it is taken or withdrawn, or until a stop.

    The item is cancelled when it is read after a stop, not by an event of the stop: an answer that
    is given before that event arrives must not count. The action that follows passes the gate with
    ``permit``, which was issued when the item began to wait.
    """

    def __init__(self, session: MotionSession) -> None:
        self._session = session
        self._item: PendingItem | None = None
        self.permit: Permit = session.permit()

    @property
    def item(self) -> PendingItem | None:
        """The waiting item, or None."""
        if self.permit.epoch != self._session.epoch:
            self._item = None
        return self._item

    def put(self, item: PendingItem) -> None:
        """Store an item that waits; it replaces the previous one."""
        self.permit = self._session.permit()
        self._item = item

    def withdraw(self) -> None:
        """Cancel the waiting item."""
        self._item = None

    def take(self) -> PendingItem | None:
        """Remove and return the waiting item; None if there is none."""
        item, self._item = self.item, None
        return item


class WaitingRequest:
    """One request that waits.

    Parameters
    ----------
    requests : OperatorRequests
        Where the request is made and its end is reported.
    withdrawn : str
        Text that reports a withdrawal, with a field ``{why}``: "Not played: {why}. Press Play
        again."
    permit : Permit, optional
        Permit issued when the operator made the request, if that was before this call.
    done, undone : callable
        One of them is called once: ``done`` if the request was accepted, else ``undone``.
    """

    def __init__(
        self,
        requests: OperatorRequests,
        withdrawn: str,
        permit: Permit | None = None,
        on_accepted: Callable[[], object] = lambda: None,
        on_refused: Callable[[], object] = lambda: None,
    ) -> None:
        self._requests, self._withdrawal_text = requests, withdrawn
        self.permit = requests.session.permit() if permit is None else permit
        self._done, self._undone = on_accepted, on_refused
        self._has_ended = False

    @property
    def is_waiting(self) -> bool:
        """Whether it is still waiting.

        Reading this withdraws the request if its permit has become invalid, for example by a stop.
        """
        permit_epoch, current_epoch = self.permit.epoch, self._requests.session.epoch
        if permit_epoch.connections != current_epoch.connections:
            self.withdraw(translate("shell", "the connection has changed meanwhile"))
        elif permit_epoch.stops != current_epoch.stops:
            self.withdraw(translate("shell", "a stop came meanwhile"))
        elif permit_epoch != current_epoch:
            self.withdraw(translate("shell", "the lock was released meanwhile"))
        return not self._has_ended

    def make(self, action: Callable[[], object]) -> None:
        """Make the request in the background; a refusal is reported.

        ``action`` passes the gate with :attr:`permit`.
        """
        if self.is_waiting:
            self._has_ended = True
            self._requests.ask_in_background(action, self._done, self._undone)

    def withdraw(self, why: str) -> None:
        """End the request without effect and report the reason."""
        if self._end():
            self._requests.withdrawn.emit(self._withdrawal_text.format(why=why))

    def end_silently(self) -> None:
        """End the request without a report: the operator cancelled it or knows the reason."""
        self._end()

    def is_repeat_of(self, other: "WaitingRequest") -> bool:
        """Return whether this requests the same as another one."""
        return self._withdrawal_text == other._withdrawal_text

    def _end(self) -> bool:
        was_open, self._has_ended = not self._has_ended, True
        if was_open:
            self._undone()
        return was_open

    # Former names, which work for one more release.
    give_up = FormerMember("end_silently")
    repeats = FormerMember("is_repeat_of")
    waits = FormerMember("is_waiting")


class AtRestScheduler:
    """Scheduler that holds the latest request until the machine rests, for at most two seconds."""

    def __init__(self, requests: OperatorRequests, clock: Clock = time.monotonic) -> None:
        self._requests, self._clock = requests, clock
        self._request: WaitingRequest | None = None
        self._action: Callable[[], object] = lambda: None
        self._request_time_s = 0.0

    @property
    def waiting(self) -> bool:
        """Whether a request is waiting for the machine to rest."""
        return self._request is not None

    @property
    def objection(self) -> str | None:
        """Why nothing else may be started now; None if nothing is waiting."""
        if self._request is None:
            return None
        return translate("shell", "a request waits until the machine is at rest")

    @property
    def waiting_text(self) -> str:
        """Text to show next to a button while its request is waiting, else ""."""
        if self._request is None:
            return ""
        return translate("shell", "Waits until the machine is at rest …")

    def do(self, request: WaitingRequest, action: Callable[[], object]) -> None:
        """Make a request now, or as soon as the machine has come to rest.

        A request that is already waiting is withdrawn; if it is the same one, the new one replaces
        it silently.
        """
        previous, self._request = self._request, request
        self._action, self._request_time_s = action, self._clock()
        if previous is not None and request.is_repeat_of(previous):
            # The new request has the same effect.
            previous.end_silently()
        elif previous is not None:
            previous.withdraw(translate("shell", "another request took its place"))
        self.make_if_resting(self._requests.session.snapshot())

    def make_if_resting(self, state: SessionState) -> None:
        """Make the waiting request if the machine rests or need not be waited for."""
        request = self._request
        if request is None:
            return
        may_settle = state.activity in (DeviceState.IDLE, DeviceState.MOVING)
        is_ready = self._requests.session.at_rest or not may_settle or state.lock_reason is not None
        if not request.is_waiting:
            self._request = None
        elif is_ready or self._clock() - self._request_time_s >= MAX_WAIT_S:
            self._request = None
            request.make(self._action)

    # Former names, which work for one more release.
    against_another = FormerMember("objection")
    look = FormerMember("make_if_resting")
    words = FormerMember("waiting_text")


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        AtRest="AtRestScheduler",
        LONGEST_S="MAX_WAIT_S",
    )
