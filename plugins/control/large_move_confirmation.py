"""Two-step confirmation of a large move: typed, read back, confirmed. Free of Qt."""

from dataclasses import dataclass

from rotemina.app.motion.session import MotionSession
from rotemina.app.shell.pending_confirmations import Pending
from rotemina.drivers.gate import Permit

LARGE = 0.1  # of the range; beyond it a move is asked for twice
SETTLE_S = 0.5  # a double click is no answer


@dataclass(frozen=True, slots=True)
class Asked:
    """A move that waits for its confirmation: from where, to where, and since when."""

    target: float
    command: float
    since_s: float


class Confirmation:
    """Whether a target may be gone to now; for one axis of a range ``span``, m or rad.

    A stop withdraws the question.
    """

    def __init__(self, span: float, session: MotionSession) -> None:
        self._span, self._session = span, session
        self._pending: Pending[Asked] = Pending(session)

    @property
    def asked(self) -> Asked | None:
        """The move that waits to be confirmed."""
        return self._pending.what

    def take(self, target: float, command: float, now_s: float) -> Permit | None:
        """Return the permit to go, or None: a large move has to be asked for again.

        It is that of the question: no stop that came after it lets the answer count.
        """
        if abs(target - command) <= LARGE * self._span:
            self._pending.withdraw()
            return self._session.permit()
        asked = self.asked
        if asked is None or (asked.target, asked.command) != (target, command):
            self._pending.put(Asked(target, command, now_s))
            return None
        if now_s - asked.since_s < SETTLE_S:
            return None
        self._pending.withdraw()
        return self._pending.permit

    def withdraw(self) -> None:
        """Cancel the pending question."""
        self._pending.withdraw()

    def follow(self, command: float | None) -> None:
        """Withdraw the question where the axis is not where it was asked."""
        asked = self.asked
        if asked is not None and command != asked.command:
            self._pending.withdraw()
