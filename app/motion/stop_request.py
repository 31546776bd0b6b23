"""Who asked for a stop, why, and when."""

from dataclasses import dataclass
from datetime import datetime

PROGRAM = "program"  # whatever stops without being asked by a person


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
        told = f"Stopped by the {self.by} at {self.at:%H:%M:%S}"
        return f"{told}: {self.why}" if self.why else told
