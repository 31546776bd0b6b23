"""A large move is asked for twice: typed, read back with its unit, and confirmed. Free of Qt."""

from dataclasses import dataclass

LARGE = 0.1  # of the range; beyond it a move is asked for twice
SETTLE_S = 0.5  # a double click is no answer


@dataclass(frozen=True, slots=True)
class Asked:
    """A move that waits for its confirmation: from where, to where, and since when."""

    target: float
    command: float
    since_s: float


class Confirmation:
    """Whether a target may be gone to now; for one axis of a range ``span``, m or rad."""

    def __init__(self, span: float) -> None:
        self._span = span
        self.asked: Asked | None = None

    def take(self, target: float, command: float, now_s: float) -> bool:
        """Return whether to go; a large move has to be asked for once more."""
        if abs(target - command) <= LARGE * self._span:
            self.asked = None
            return True
        asked = self.asked
        if asked is None or (asked.target, asked.command) != (target, command):
            self.asked = Asked(target, command, now_s)
            return False
        if now_s - asked.since_s < SETTLE_S:
            return False
        self.asked = None
        return True

    def withdraw(self) -> None:
        """Wait for nothing any more."""
        self.asked = None

    def follow(self, command: float | None) -> None:
        """Withdraw the question where the axis is not where it was asked."""
        if self.asked is not None and command != self.asked.command:
            self.asked = None
