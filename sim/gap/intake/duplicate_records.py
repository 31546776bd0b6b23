"""Duplicate measurements, which cannot validate a fit."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.cautions import Labelled
from rotemina.sim.messages import message
from rotemina.sim.records.record import Channel, Record, Tap

_WINDOW_ROWS = 200  # that are looked for in the other record
_CHANGES = 50  # of a reading in them: too many to agree by chance
_SAME = 1e-12  # relative: a reading may have been written in another unit


def check_copies(records: Sequence[Labelled]) -> None:
    """Refuse records that contain the same measurements, in whole or in part.

    Two measurements of one motion never agree in all digits of their noise. A fit needs validation
    data that it did not use, and a copy was used.

    Raises
    ------
    GapError
        With both names.
    """
    for one, other in combinations(records, 2):
        channel = _shared(one.record, other.record)
        if channel is None:
            continue
        signals = [each.record.signal(*channel) for each in (one, other)]
        if _holds_part(*signals) or _holds_part(*reversed(signals)):
            raise GapError(
                message(
                    "gap",
                    "{name}: it holds measurements of {one_name} again ({channel}); give each "
                    "record once, and parts of one record without overlap",
                ).fill(name=other.name, one_name=one.name, channel=str(channel))
            )


def _shared(one: Record, other: Record) -> Channel | None:
    """Return the most informative measured channel of both, or None."""
    measured = [
        channel
        for channel in one.columns
        if channel.tap in (Tap.REF, Tap.MEAS) and channel in other.columns
    ]
    return max(measured, key=lambda channel: _changes(one.signal(*channel)), default=None)


def _changes(signal: FloatArray) -> int:
    return int(np.count_nonzero(np.diff(signal)))


def _holds_part(whole: FloatArray, part: FloatArray) -> bool:
    """Whether the first, middle or last rows of ``part`` are found in ``whole``."""
    rows = min(_WINDOW_ROWS, len(part))
    begins = {0, (len(part) - rows) // 2, len(part) - rows}
    windows = [part[begin : begin + rows] for begin in sorted(begins)]
    return any(_found(whole, window) for window in windows if _changes(window) >= _CHANGES)


def _found(whole: FloatArray, window: FloatArray) -> bool:
    if len(window) > len(whole):
        return False
    room = len(whole) - len(window) + 1
    size = _SAME * float(np.abs(window).max())
    begins = np.flatnonzero(np.abs(whole[:room] - window[0]) <= size)
    return any(
        np.abs(whole[begin : begin + len(window)] - window).max() <= size for begin in begins
    )
