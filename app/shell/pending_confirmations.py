"""What waits for an answer of the operator's, or for its turn; a stop withdraws it. Free of Qt."""

from typing import Generic, TypeVar

from rotemina.app.motion.session import MotionSession
from rotemina.drivers.gate import Permit

What = TypeVar("What")


class Pending(Generic[What]):
    """One thing that waits until it is taken, withdrawn, or someone stops.

    It is looked for a stop when it is read, not when one is told of: an answer that was given
    before the news arrived counts no more than a later one. What it leads to passes the gate with
    ``permit``, drawn when it began to wait.
    """

    def __init__(self, session: MotionSession) -> None:
        self._session = session
        self._what: What | None = None
        self.permit: Permit = session.permit()

    @property
    def what(self) -> What | None:
        """What waits; None where nothing does any more."""
        if self.permit.epoch != self._session.epoch:
            self._what = None
        return self._what

    def put(self, what: What) -> None:
        """Have something wait, in place of what did."""
        self.permit = self._session.permit()
        self._what = what

    def withdraw(self) -> None:
        """Have nothing wait any more."""
        self._what = None

    def take(self) -> What | None:
        """Return what waits, and have it wait no more."""
        what, self._what = self.what, None
        return what
