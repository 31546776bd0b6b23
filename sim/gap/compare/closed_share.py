"""Which share of a gap is closed."""


def closed(before: float, after: float) -> float:
    """Return the share, within 0 and 1, of a gap that is closed; both mean squares over the floor.

    A gap within the floor counts as closed.
    """
    if before <= 1.0:
        return 1.0
    return min(max(1.0 - (after - 1.0) / (before - 1.0), 0.0), 1.0)
