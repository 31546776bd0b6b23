"""Decides whether the trainer or the trainee drives.

The trainer takes over by moving the stick, the trainee only on request.
"""

from dataclasses import dataclass

from rotemina.app.motion.inputs.profile import OperatorRole
from rotemina.sim.messages import message

#: The trainer takes over with this deflection, clearly beyond the dead zone and well below an end.
MIN_TAKEOVER_DEFLECTION = 0.25


@dataclass(frozen=True, slots=True)
class SeatState:
    """Current state of the devices of one operator.

    Attributes
    ----------
    is_present : bool
        Whether at least one usable device is plugged in.
    requests_control : bool
        Whether TAKE_OVER was pressed on one of the devices.
    max_deflection : float
        Largest deflection of the trusted axes, 0 to 1.
    """

    is_present: bool
    requests_control: bool
    max_deflection: float


class Takeover:
    """Decides which operator drives; at first it is the trainer.

    TAKE_OVER always gives control to the operator who presses it. It has no effect for the operator
    who already drives, so a trainer who presses it in alarm never loses control. The trainee gets
    control only while the trainer's device is connected and still.
    """

    def __init__(self) -> None:
        self.driving_seat = OperatorRole.TRAINER

    def decide(self, trainer: SeatState, trainee: SeatState) -> str | None:
        """Decide who drives; return why the other operator has lost control, or None."""
        reason = None
        if self.driving_seat is OperatorRole.TRAINEE:
            if not trainer.is_present:
                reason = message(
                    "engine",
                    "the trainer's device is not connected: the trainee cannot drive alone",
                )
            elif trainer.requests_control or trainer.max_deflection >= MIN_TAKEOVER_DEFLECTION:
                reason = message("engine", "the trainer has taken over")
        elif trainee.requests_control and self._can_grant(trainer, trainee):
            reason = message("engine", "the trainee has taken over")
        if reason is not None:
            self.driving_seat = (
                OperatorRole.TRAINER
                if self.driving_seat is OperatorRole.TRAINEE
                else OperatorRole.TRAINEE
            )
        return reason

    @staticmethod
    def _can_grant(trainer: SeatState, trainee: SeatState) -> bool:
        is_trainer_still = (
            trainer.is_present
            and not trainer.requests_control
            and trainer.max_deflection < MIN_TAKEOVER_DEFLECTION
        )
        return is_trainer_still and trainee.is_present
