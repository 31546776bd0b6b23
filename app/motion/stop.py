"""A stop: who requested it, why and when."""

from dataclasses import dataclass
from datetime import datetime

from rotemina.sim.messages import message

PROGRAM = "program"  # whatever stops without being asked by a person
LOCKED = message("engine", "stop and lock")  # why, where that button or key was pressed


@dataclass(frozen=True, slots=True)
class StopRequest:
    """One stop.

    Attributes
    ----------
    by : str
        ``ownership.OPERATOR`` where a person asked for it; ``PROGRAM`` otherwise.
    why : str
        The reason; it may be empty for an operator's.
    at : datetime
        Local time.
    """

    by: str
    why: str
    at: datetime

    def __str__(self) -> str:
        """Return it in a sentence."""
        when = f"{self.at:%H:%M:%S}"
        if self.why:
            return message("engine", "Stopped by the {who} at {time}: {why}").fill(
                who=self.by, time=when, why=self.why
            )
        return message("engine", "Stopped by the {who} at {time}").fill(who=self.by, time=when)
