"""What can be said of an axis, given the best explanation of its gap and its rivals."""

from collections.abc import Sequence

from rotemina.sim.gap.diagnosis import Verdict

_MOST_LEFT = 0.3  # of the gap's power, that an explanation may leave
_LEFT_OF_MUCH = 0.13  # the same where that is far above the floor
_MUCH = 25.0  # mean square over the floor that is far above it
_MOST_RIVALS = 4  # from which a record cannot tell


def decide(
    raw: float, left: float, ambiguous: Sequence[Sequence[str]], *, wanders: bool = False
) -> Verdict:
    """Return the verdict on an axis that has a gap.

    Parameters
    ----------
    raw, left : float
        Mean square over the floor of the gap, and of what the best explanation leaves of it on
        data that it did not see.
    ambiguous : sequence of sequence of str
        For each cause, the effects that cannot be told from it.
    wanders : bool
        Whether a sensor wanders, whose share is known but roughly.
    """
    much = left > _MUCH and not wanders
    if closed(raw, left) < 1.0 - (_LEFT_OF_MUCH if much else _MOST_LEFT):
        return Verdict.UNKNOWN
    if any(len(others) >= _MOST_RIVALS for others in ambiguous):
        return Verdict.INSUFFICIENT
    return Verdict.EXPLAINED


def closed(before: float, after: float) -> float:
    """Return the share, within 0 and 1, of a gap that is closed; both mean squares over the floor.

    A gap within the floor counts as closed.
    """
    if before <= 1.0:
        return 1.0
    return min(max(1.0 - (after - 1.0) / (before - 1.0), 0.0), 1.0)
