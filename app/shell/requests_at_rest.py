"""A request that is made as soon as the machine rests, which it is about to."""

import time
from collections.abc import Callable

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.operator_requests import Requests
from rotemina.drivers.clock import Clock
from rotemina.drivers.gate import Permit
from rotemina.drivers.samples import DeviceState

LONGEST_S = 2.0  # a machine that moves for longer is not about to rest: the session says so


class AtRest:
    """Holds one request, the latest; it is made within two seconds or not at all.

    A stop that comes meanwhile takes its permit away, and with it the request.
    """

    def __init__(self, requests: Requests, clock: Clock = time.monotonic) -> None:
        self._requests, self._clock = requests, clock
        self._held: tuple[Callable[[], object], Permit, float] | None = None

    @property
    def waiting(self) -> bool:
        """Whether a request waits for the machine to rest."""
        return self._held is not None

    def do(self, request: Callable[[], object], permit: Permit) -> None:
        """Make a request now, or when what is under way has come to rest."""
        self._held = request, permit, self._clock()
        self.look(self._requests.session.snapshot())

    def look(self, state: SessionState) -> None:
        """Make the request that waits, once there is nothing to wait for."""
        if self._held is None:
            return
        request, permit, since_s = self._held
        if not permit.valid:
            self._held = None
            return
        settling = state.activity in (DeviceState.IDLE, DeviceState.MOVING)
        resting = self._requests.session.at_rest or not settling or state.locked is not None
        if resting or self._clock() - since_s >= LONGEST_S:
            self._held = None
            self._requests.ask_aside(request)
