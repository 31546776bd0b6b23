"""Requests of the operator that wait, until the machine rests or a dry run has ended.

Each ends once: it is taken, refused or withdrawn. A refusal and a withdrawal are always reported,
so that no click is lost without a word.
"""

import time
from collections.abc import Callable

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.language import translate
from rotemina.app.shell.operator_requests import Requests
from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import DeviceState

LONGEST_S = 2.0  # a machine that moves for longer is not about to rest: the session says so


class WaitingRequest:
    """One request that waits.

    Parameters
    ----------
    requests : Requests
        Where it is made, and where its end is reported.
    withdrawn : str
        Reported when it is withdrawn, with a field ``{why}``: "Not played: {why}. Press Play
        again."
    permit : Permit, optional
        Of the moment of the request, where that was before this call.
    done, undone : callable
        Called once, when it was taken or was not.
    """

    def __init__(
        self,
        requests: Requests,
        withdrawn: str,
        permit: Permit | None = None,
        done: Callable[[], object] = lambda: None,
        undone: Callable[[], object] = lambda: None,
    ) -> None:
        self._requests, self._withdrawn = requests, withdrawn
        self.permit = requests.session.permit() if permit is None else permit
        self._done, self._undone = done, undone
        self._ended = False

    @property
    def waits(self) -> bool:
        """Whether it has yet to end; one that a stop has overtaken is withdrawn by this."""
        before, now = self.permit.epoch, self._requests.session.epoch
        if before.connections != now.connections:
            self.withdraw(translate("shell", "the connection has changed meanwhile"))
        elif before.stops != now.stops:
            self.withdraw(translate("shell", "a stop came meanwhile"))
        elif before != now:
            self.withdraw(translate("shell", "the lock was released meanwhile"))
        return not self._ended

    def make(self, action: Callable[[], object]) -> None:
        """Make the request, away from the window's thread; a refusal is reported.

        ``action`` passes the gate with :attr:`permit`.
        """
        if self.waits:
            self._ended = True
            self._requests.ask_aside(action, self._done, self._undone)

    def withdraw(self, why: str) -> None:
        """End it without effect, and report why."""
        if self._end():
            self._requests.withdrawn.emit(self._withdrawn.format(why=why))

    def give_up(self) -> None:
        """End it without effect and without a word: the operator cancelled it, or knows why."""
        self._end()

    def repeats(self, other: "WaitingRequest") -> bool:
        """Return whether this asks for the same as another one."""
        return self._withdrawn == other._withdrawn

    def _end(self) -> bool:
        ends, self._ended = not self._ended, True
        if ends:
            self._undone()
        return ends


class AtRest:
    """Holds one request, the latest, until the machine rests, but two seconds at most."""

    def __init__(self, requests: Requests, clock: Clock = time.monotonic) -> None:
        self._requests, self._clock = requests, clock
        self._request: WaitingRequest | None = None
        self._action: Callable[[], object] = lambda: None
        self._since_s = 0.0

    @property
    def waiting(self) -> bool:
        """Whether a request waits for the machine to rest."""
        return self._request is not None

    @property
    def against_another(self) -> str | None:
        """Return why nothing else may be begun now; None while nothing waits."""
        if self._request is None:
            return None
        return translate("shell", "a request waits until the machine is at rest")

    @property
    def words(self) -> str:
        """Text for the place next to a button while its request waits; empty while none does."""
        if self._request is None:
            return ""
        return translate("shell", "Waits until the machine is at rest …")

    def do(self, request: WaitingRequest, action: Callable[[], object]) -> None:
        """Make a request now, or when what is under way has come to rest.

        One that waits already is withdrawn; if it is the same one, pressed again, it goes on.
        """
        replaced, self._request = self._request, request
        self._action, self._since_s = action, self._clock()
        if replaced is not None and request.repeats(replaced):
            replaced.give_up()  # its repetition will have its effect
        elif replaced is not None:
            replaced.withdraw(translate("shell", "another request took its place"))
        self.look(self._requests.session.snapshot())

    def look(self, state: SessionState) -> None:
        """Make the request that waits, once there is nothing to wait for."""
        request = self._request
        if request is None:
            return
        settling = state.activity in (DeviceState.IDLE, DeviceState.MOVING)
        resting = self._requests.session.at_rest or not settling or state.locked is not None
        if not request.waits:
            self._request = None
        elif resting or self._clock() - self._since_s >= LONGEST_S:
            self._request = None
            request.make(self._action)
