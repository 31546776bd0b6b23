"""The quality of the communication line to a device."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LinkQuality:
    """Counts since the line was opened, and times and load of the line.

    Attributes
    ----------
    sent, received : int
        Numbers of frames.
    rejected : int
        Number of byte sequences that were not a valid frame or message.
    repeated : int
        Number of frames that had to be sent again.
    round_trip_s : float or None
        Smoothed time from sending a frame to its answer, s; None before the first answer.
    stop_s : float
        Time that a stop requested now would need until its last byte is sent, s.
    load : float
        Fraction of the line's capacity that was recently used, 0 to 1.
    """

    sent: int = 0
    received: int = 0
    rejected: int = 0
    repeated: int = 0
    round_trip_s: float | None = None
    stop_s: float = 0.0
    load: float = 0.0


def combine_link_quality(lines: Sequence[LinkQuality]) -> LinkQuality:
    """Combine lines: sum their counts, and take the largest of their times and loads."""
    round_trips_s = [line.round_trip_s for line in lines if line.round_trip_s is not None]
    return LinkQuality(
        sent=sum(line.sent for line in lines),
        received=sum(line.received for line in lines),
        rejected=sum(line.rejected for line in lines),
        repeated=sum(line.repeated for line in lines),
        round_trip_s=max(round_trips_s, default=None),
        stop_s=max((line.stop_s for line in lines), default=0.0),
        load=max((line.load for line in lines), default=0.0),
    )
