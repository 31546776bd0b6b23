"""Confirmation of a large move by a second press. Does not use Qt."""

from dataclasses import dataclass

from rotemina.app.motion.session import MotionSession
from rotemina.app.workbench import PendingConfirmation
from rotemina.drivers.contract import Permit

# A move over more than this fraction of the range must be confirmed.
LARGE_MOVE_FRACTION = 0.1
# A second press within this time is ignored, so that a double click does not confirm the move.
MIN_ANSWER_DELAY_S = 0.5


@dataclass(frozen=True, slots=True)
class UnconfirmedMove:
    """Move that waits for confirmation.

    Attributes
    ----------
    target : float
        Position to move to, m or rad.
    command : float
        Commanded position when the move was requested, m or rad.
    since_s : float
        Time of the request, s.
    """

    target: float
    command: float
    since_s: float


class LargeMoveConfirmation:
    """Confirmation of large moves of one axis. A stop cancels it.

    Parameters
    ----------
    span : float
        Length of the range of the axis, m or rad.
    session : MotionSession
    """

    def __init__(self, span: float, session: MotionSession) -> None:
        self._span, self._session = span, session
        self._pending: PendingConfirmation[UnconfirmedMove] = PendingConfirmation(session)

    @property
    def unconfirmed_move(self) -> UnconfirmedMove | None:
        """The move that waits for confirmation, or None."""
        return self._pending.item

    def request_permit(self, target: float, command: float, now_s: float) -> Permit | None:
        """Return the permit to move, or None if a large move has to be confirmed first.

        The permit of a confirmed move was issued at the first press, so a stop after that press
        makes it invalid.
        """
        if abs(target - command) <= LARGE_MOVE_FRACTION * self._span:
            self._pending.withdraw()
            return self._session.permit()
        move = self.unconfirmed_move
        if move is None or (move.target, move.command) != (target, command):
            self._pending.put(UnconfirmedMove(target, command, now_s))
            return None
        if now_s - move.since_s < MIN_ANSWER_DELAY_S:
            return None
        self._pending.withdraw()
        return self._pending.permit

    def cancel(self) -> None:
        """Cancel the move that waits for confirmation."""
        self._pending.withdraw()

    def cancel_if_moved(self, command: float | None) -> None:
        """Cancel the waiting move if the commanded position has changed since the request."""
        move = self.unconfirmed_move
        if move is not None and command != move.command:
            self._pending.withdraw()
