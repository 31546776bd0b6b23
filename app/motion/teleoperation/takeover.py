"""Which of two seats is in control: the trainer takes over at once, the trainee only on request."""

from dataclasses import dataclass

from rotemina.app.motion.teleoperation.profile import OperatorRole
from rotemina.sim.messages import message

#: Deflection by which the trainer takes over: clearly beyond the dead zone, well below an end.
MOVED = 0.25


@dataclass(frozen=True, slots=True)
class RoleState:
    """What a seat's devices do now.

    Attributes
    ----------
    present : bool
        Whether one of them that can drive is plugged in.
    asks : bool
        Whether TAKE_OVER was pressed there.
    most : float
        The greatest deflection of their trusted axes, 0 to 1.
    """

    present: bool
    asks: bool
    most: float


class Takeover:
    """Begins with the trainer.

    TAKE_OVER means *this one drives now*, at each seat, and nothing where that is so already: a
    trainer who presses it in alarm never gives the drive away. The trainee gets it only while the
    trainer is there and keeps still.
    """

    def __init__(self) -> None:
        self.driving = OperatorRole.TRAINER

    def decide(self, trainer: RoleState, trainee: RoleState) -> str | None:
        """Decide which seat is in control; return why the previous one lost control, or None."""
        reason = None
        if self.driving is OperatorRole.TRAINEE:
            if not trainer.present:
                reason = message(
                    "engine",
                    "the trainer's device is not connected: the trainee cannot drive alone",
                )
            elif trainer.asks or trainer.most >= MOVED:
                reason = message("engine", "the trainer has taken over")
        elif trainee.asks and self._granted(trainer, trainee):
            reason = message("engine", "the trainee has taken over")
        if reason is not None:
            self.driving = (
                OperatorRole.TRAINER
                if self.driving is OperatorRole.TRAINEE
                else OperatorRole.TRAINEE
            )
        return reason

    @staticmethod
    def _granted(trainer: RoleState, trainee: RoleState) -> bool:
        still = trainer.present and not trainer.asks and trainer.most < MOVED
        return still and trainee.present
