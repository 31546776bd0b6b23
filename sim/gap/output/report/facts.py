"""What was diagnosed: facts about records and robot that let others repeat it."""

from collections.abc import Sequence
from hashlib import sha256
from typing import NamedTuple

import numpy as np

from rotemina.sim.gap.output.report.words import said, shown
from rotemina.sim.messages import marked
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record

_EVEN = 1e-3  # relative spread of sample intervals up to which a record counts as evenly sampled
_MOST_METADATA = 30
_MOST_LETTERS = 200
_FINGERPRINT = 16  # letters of the hash


class RecordFacts(NamedTuple):
    """One record, in words."""

    name: str
    rows: int
    duration: str
    rate: str
    channels: str
    loop: str
    history: str
    fingerprint: str
    metadata: tuple[tuple[str, str], ...]


def record_facts(records: Sequence[Record], names: Sequence[str]) -> list[RecordFacts]:
    """Return the facts of every record; ``names`` may be fewer, or none."""
    named = [*names, *[""] * len(records)]
    return [_facts(record, name) for record, name in zip(records, named, strict=False)]


def _facts(record: Record, name: str) -> RecordFacts:
    return RecordFacts(
        name=name,
        rows=len(record.time_s),
        duration=f"{shown(rounded(record.duration_s))} s",
        rate=_rate(record),
        channels=", ".join(map(str, record.columns)),
        loop=said(
            marked("gap", "closed loop") if record.closed_loop else marked("gap", "open loop")
        ),
        history=record.history,
        fingerprint=_fingerprint(record),
        metadata=tuple(
            (key[:_MOST_LETTERS], value[:_MOST_LETTERS])
            for key, value in list(record.metadata.items())[:_MOST_METADATA]
        ),
    )


def _rate(record: Record) -> str:
    intervals = np.diff(record.time_s)
    if not len(intervals):
        return said(marked("gap", "one row"))
    mean = float(intervals.mean())
    even = float(np.ptp(intervals)) <= _EVEN * mean
    rate = rounded(1.0 / mean, 5)
    if even:
        return f"{shown(rate)} Hz"
    return said(marked("gap", "uneven, {rate} Hz on average"), rate=rate)


def _fingerprint(record: Record) -> str:
    """Return a fingerprint of a record that does not depend on its file name."""
    content = sha256(",".join(map(str, record.columns)).encode("utf-8", "replace"))
    content.update(np.ascontiguousarray(record.time_s).tobytes())
    content.update(np.ascontiguousarray(record.values).tobytes())
    return content.hexdigest()[:_FINGERPRINT]
