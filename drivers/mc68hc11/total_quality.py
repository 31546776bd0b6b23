"""The quality of several lines, seen as one."""

from collections.abc import Sequence

from rotemina.drivers.line_quality import LinkQuality


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
