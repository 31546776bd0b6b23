"""Facts about the diagnosed records, with which others can check and repeat the diagnosis."""

from collections.abc import Sequence
from hashlib import sha256
from typing import NamedTuple

import numpy as np

from rotemina.sim.gap.output.report_words import localize, localize_text
from rotemina.sim.messages import format_rounded, marked
from rotemina.sim.records import Record

# A record counts as evenly sampled if the relative spread of its intervals is at most this.
_MAX_INTERVAL_SPREAD_RATIO = 1e-3
_MAX_METADATA_ENTRIES = 30
_MAX_METADATA_LENGTH = 200
_FINGERPRINT_LENGTH = 16


class RecordFacts(NamedTuple):
    """The facts about one record, as the report shows them."""

    name: str
    rows: int
    duration: str
    rate: str
    channels: str
    loop: str
    history: str
    fingerprint: str
    metadata: tuple[tuple[str, str], ...]


def collect_record_facts(records: Sequence[Record], names: Sequence[str]) -> list[RecordFacts]:
    """Return the facts about every record; ``names`` may be shorter than ``records``."""
    all_names = [*names, *[""] * len(records)]
    return [_collect_facts(record, name) for record, name in zip(records, all_names, strict=False)]


def _collect_facts(record: Record, name: str) -> RecordFacts:
    return RecordFacts(
        name=name,
        rows=len(record.time_s),
        duration=f"{localize(format_rounded(record.duration_s))} s",
        rate=_describe_rate(record),
        channels=", ".join(map(str, record.columns)),
        loop=localize_text(
            marked("gap", "closed loop") if record.closed_loop else marked("gap", "open loop")
        ),
        history=record.history,
        fingerprint=_compute_fingerprint(record),
        metadata=tuple(
            (key[:_MAX_METADATA_LENGTH], value[:_MAX_METADATA_LENGTH])
            for key, value in list(record.metadata.items())[:_MAX_METADATA_ENTRIES]
        ),
    )


def _describe_rate(record: Record) -> str:
    intervals_s = np.diff(record.time_s)
    if not len(intervals_s):
        return localize_text(marked("gap", "one row"))
    mean_interval_s = float(intervals_s.mean())
    is_even = float(np.ptp(intervals_s)) <= _MAX_INTERVAL_SPREAD_RATIO * mean_interval_s
    rate = format_rounded(1.0 / mean_interval_s, 5)
    if is_even:
        return f"{localize(rate)} Hz"
    return localize_text(marked("gap", "uneven, {rate} Hz on average"), rate=rate)


def _compute_fingerprint(record: Record) -> str:
    """Return a fingerprint of a record that does not depend on its file name."""
    digest = sha256(",".join(map(str, record.columns)).encode("utf-8", "replace"))
    digest.update(np.ascontiguousarray(record.time_s).tobytes())
    digest.update(np.ascontiguousarray(record.values).tobytes())
    return digest.hexdigest()[:_FINGERPRINT_LENGTH]
