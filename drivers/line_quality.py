"""The quality of a device's line."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LinkQuality:
    """Counts since the line was opened, and times, s.

    Attributes
    ----------
    sent, received : int
        Frames.
    rejected : int
        Stretches of bytes that were no frame, or no message.
    repeated : int
        Frames that had to be said again.
    round_trip_s : float or None
        From a frame to its answer, smoothed; None before the first.
    stop_s : float
        How long a stop that is requested now would take until its last byte is out.
    load : float
        Share of the line that was used lately, 0 to 1.
    """

    sent: int = 0
    received: int = 0
    rejected: int = 0
    repeated: int = 0
    round_trip_s: float | None = None
    stop_s: float = 0.0
    load: float = 0.0


def total_quality(lines: Sequence[LinkQuality]) -> LinkQuality:
    """Return the sums of all counts, and the worst of all times and loads."""
    trips = [one.round_trip_s for one in lines if one.round_trip_s is not None]
    return LinkQuality(
        sent=sum(one.sent for one in lines),
        received=sum(one.received for one in lines),
        rejected=sum(one.rejected for one in lines),
        repeated=sum(one.repeated for one in lines),
        round_trip_s=max(trips, default=None),
        stop_s=max((one.stop_s for one in lines), default=0.0),
        load=max((one.load for one in lines), default=0.0),
    )
