"""Check for duplicate measurements, which cannot validate a fit."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake.cautions import LabelledRecord
from rotemina.sim.records import (
    Record,
    RecordChannel,
    Tap,
)

# Windows of this many rows of one record are searched for in the other.
_WINDOW_ROWS = 200
# Windows with at least this many changes of value cannot match by chance.
_MIN_CHANGES = 50
# Equal readings may differ by rounding, because they may have been written in another unit.
_RELATIVE_TOLERANCE = 1e-12


def check_duplicates(records: Sequence[LabelledRecord]) -> None:
    """Refuse records that share measurements, in whole or in part.

    Two measurements of the same motion never have identical noise down to the last digit. A fit
    must be validated on data that it has not seen, and a copy of its data is not such data.

    Raises
    ------
    GapError
        If two records share measurements. The message names both.
    """
    for first, second in combinations(records, 2):
        channel = _find_shared_channel(first.record, second.record)
        if channel is None:
            continue
        signals = [labelled.record.signal(*channel) for labelled in (first, second)]
        if _contains_part_of(*signals) or _contains_part_of(*reversed(signals)):
            raise GapError(
                "{name}: it contains the same measurements as {one_name} ({channel}); give "
                "each record once, and parts of one record without overlap",
                name=second.name,
                one_name=first.name,
                channel=str(channel),
            )


def _find_shared_channel(first: Record, second: Record) -> RecordChannel | None:
    """Return the measured channel of both records that changes most often, or None."""
    # REF is the reference sensor, so it is a measurement too.
    measured = [
        channel
        for channel in first.columns
        if channel.tap in (Tap.REF, Tap.MEAS) and channel in second.columns
    ]
    return max(measured, key=lambda channel: _count_changes(first.signal(*channel)), default=None)


def _count_changes(signal: FloatArray) -> int:
    return int(np.count_nonzero(np.diff(signal)))


def _contains_part_of(signal: FloatArray, other: FloatArray) -> bool:
    """Return whether ``signal`` contains the first, middle or last rows of ``other``."""
    rows = min(_WINDOW_ROWS, len(other))
    offsets = {0, (len(other) - rows) // 2, len(other) - rows}
    windows = [other[offset : offset + rows] for offset in sorted(offsets)]
    return any(
        _contains_window(signal, window)
        for window in windows
        if _count_changes(window) >= _MIN_CHANGES
    )


def _contains_window(signal: FloatArray, window: FloatArray) -> bool:
    if len(window) > len(signal):
        return False
    offset_count = len(signal) - len(window) + 1
    tolerance = _RELATIVE_TOLERANCE * float(np.abs(window).max())
    offsets = np.flatnonzero(np.abs(signal[:offset_count] - window[0]) <= tolerance)
    return any(
        np.abs(signal[offset : offset + len(window)] - window).max() <= tolerance
        for offset in offsets
    )
