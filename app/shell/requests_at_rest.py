"""A request that is made as soon as the machine rests, which it is about to."""

import time
from collections.abc import Callable
from dataclasses import dataclass

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.operator_requests import Requests
from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import DeviceState

LONGEST_S = 2.0  # a machine that moves for longer is not about to rest: the session says so


@dataclass(frozen=True, slots=True)
class _Held:
    request: Callable[[], object]
    permit: Permit
    done: Callable[[], None]
    undone: Callable[[], None]
    since_s: float


class AtRest:
    """Holds one request, the latest; it is made within two seconds or not at all.

    A stop that comes meanwhile takes its permit away, and with it the request.
    """

    def __init__(self, requests: Requests, clock: Clock = time.monotonic) -> None:
        self._requests, self._clock = requests, clock
        self._held: _Held | None = None

    @property
    def waiting(self) -> bool:
        """Whether a request waits for the machine to rest."""
        return self._held is not None

    def do(
        self,
        request: Callable[[], object],
        permit: Permit,
        done: Callable[[], None] = lambda: None,
        undone: Callable[[], None] = lambda: None,
    ) -> None:
        """Make a request now, or when what is under way has come to rest.

        ``done`` or ``undone`` is called once it was taken, or was refused, stopped or replaced.
        """
        replaced, self._held = self._held, _Held(request, permit, done, undone, self._clock())
        if replaced is not None:
            replaced.undone()
        self.look(self._requests.session.snapshot())

    def look(self, state: SessionState) -> None:
        """Make the request that waits, once there is nothing to wait for."""
        held = self._held
        if held is None:
            return
        if not held.permit.valid:
            self._held = None
            held.undone()
            return
        settling = state.activity in (DeviceState.IDLE, DeviceState.MOVING)
        resting = self._requests.session.at_rest or not settling or state.locked is not None
        if resting or self._clock() - held.since_s >= LONGEST_S:
            self._held = None
            self._requests.ask_aside(held.request, held.done, held.undone)
