"""Facts about a record, read from its file without loading the file completely."""

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime
from hashlib import sha256
from pathlib import Path
from typing import Any

from rotemina.app.motion.playback import find_worst_axis
from rotemina.app.motion.recording import RECORDING_SUFFIX, Recording
from rotemina.app.records.entry import LibraryEntry, WorstGap
from rotemina.app.records.recorded_events import EventSeverity, make_timeline_events
from rotemina.sim.comparison import compute_gap_figure, find_moving_samples
from rotemina.sim.errors import InputError
from rotemina.sim.records import (
    FileComments,
    FileLimits,
    Record,
    Tap,
    find_header_separator,
    is_comment,
    is_empty,
    looks_like_header,
    open_blocks,
    parse_separator_line,
    split_fields,
    split_headings,
)

# The digest covers this much of the beginning and of the end of a file.
_DIGESTED_END_BYTES = 65_536
_BLOCK_LIMITS = FileLimits(block_bytes=1_000_000)
# For longer recordings the gap is not computed, because it would take too long. 5 min at 1 kHz.
_MAX_GAP_SAMPLES = 300_000
_METADATA_KEYS = ("robot", "driver", "model", "effects", "run", "operator", "sample")
_UNITS_PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "µs": 1e6}


def compute_digest(path: Path) -> str:
    """Return a digest of the size, beginning and end of a file.

    This distinguishes files, because a compressed file ends with a checksum of its contents and a
    recording begins with a unique id.

    Raises
    ------
    OSError
        If the file cannot be read.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        digest = sha256(str(size).encode() + file.read(_DIGESTED_END_BYTES))
        file.seek(max(size - _DIGESTED_END_BYTES, 0))
        digest.update(file.read(_DIGESTED_END_BYTES))
    return digest.hexdigest()[:32]


def add_facts(entry: LibraryEntry) -> LibraryEntry:
    """Return the entry with the facts about its file, or with the problem of reading them.

    Raises
    ------
    OSError
        If the file does not exist or cannot be opened.
    """
    status = entry.path.stat()
    entry = replace(
        entry,
        size=status.st_size,
        stamp=status.st_mtime_ns,
        digest=compute_digest(entry.path),
        problem="",
    )
    try:
        read_facts = (
            _read_recording_facts if entry.path.suffix == RECORDING_SUFFIX else _read_text_facts
        )
        return replace(entry, **read_facts(entry.path))
    except (InputError, KeyError, ValueError) as error:
        return replace(entry, problem=str(error), duration_s=None, gap=None)


def extract_metadata_facts(metadata: Mapping[str, str]) -> dict[str, Any]:
    """Return the facts in the metadata of a record."""
    facts: dict[str, Any] = {key: metadata.get(key, "") for key in _METADATA_KEYS}
    return facts | {
        "began": parse_time(metadata.get("began", "")),
        "machine": metadata.get("robot_sha256", ""),
    }


def extract_record_facts(record: Record) -> dict[str, Any]:
    """Return the facts about a record in memory."""
    return extract_metadata_facts(record.metadata) | {"duration_s": record.duration_s}


def _read_recording_facts(path: Path) -> dict[str, Any]:
    recording = Recording.open(path)
    events = make_timeline_events(recording.read_events(), recording.began_s)
    return extract_metadata_facts(recording.metadata) | {
        "duration_s": recording.ended_s - recording.began_s,
        "events": sum(event.severity is not EventSeverity.DETAIL for event in events),
        "gap": _compute_gap(recording),
    }


def _compute_gap(recording: Recording) -> WorstGap | None:
    """Return the worst gap of a recording; None if no axis has one, or it is too long."""
    if not 0 < recording.count <= _MAX_GAP_SAMPLES:
        return None
    samples = recording.read_samples()
    is_moving = find_moving_samples(samples.host_time_s, samples.command)
    figures = {
        (axis, Tap.MEAS): compute_gap_figure(
            is_moving, samples.measured[:, column], samples.model[:, column]
        )
        for column, axis in enumerate(recording.axes)
    }
    worst_axis = find_worst_axis(figures, recording.robot)
    if worst_axis is None:
        return None
    axis, figure = worst_axis
    return WorstGap(axis, figure.rms, recording.units[axis])


def _read_text_facts(path: Path) -> dict[str, Any]:
    comments, heading, first_row, last_row = FileComments(), "", "", ""
    with open_blocks(path, _BLOCK_LIMITS) as blocks:
        for block in blocks:
            if not first_row:
                for number, line in enumerate(_decode_lines(block.data), start=block.first_line):
                    if line.startswith("#"):
                        comments.add(line, f"{path}:{number}")
                    elif is_empty(line) or is_comment(line) or parse_separator_line(line):
                        continue
                    elif not heading:
                        heading = line
                    else:
                        first_row = line
                        break
            rows = (line for line in reversed(_decode_lines(block.data[-_DIGESTED_END_BYTES:])))
            last_row = next(
                (row for row in rows if not is_empty(row) and not is_comment(row)), last_row
            )
    return extract_metadata_facts(comments.metadata) | {
        "duration_s": _compute_duration_s(heading, first_row, last_row)
    }


def _decode_lines(data: bytes) -> list[str]:
    return data.decode("utf-8", "replace").splitlines()


def _compute_duration_s(heading: str, first_row: str, last_row: str) -> float | None:
    """Return the time between two rows; None if the header differs from this program's files."""
    if not looks_like_header(heading):
        return None
    separator = find_header_separator(heading)
    name, _, unit = split_headings(heading, separator)[0].partition("[")
    units_per_s = _UNITS_PER_SECOND.get(unit.strip(" ]"))
    if name.strip() != "t" or units_per_s is None:
        return None
    times = [split_fields(row, separator)[0] for row in (first_row, last_row) if row]
    begin, end = (float(time.replace(",", ".")) for time in (times[0], times[-1]))
    return (end - begin) / units_per_s


def parse_time(text: str) -> datetime | None:
    """Return a time of the metadata, with a UTC offset; None if the text is invalid."""
    try:
        time = datetime.fromisoformat(text)
    except ValueError:
        return None
    return time if time.tzinfo is not None else time.astimezone()
