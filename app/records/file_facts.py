"""Facts from a record's own file, without loading it completely."""

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime
from hashlib import sha256
from pathlib import Path
from typing import Any

from rotemina.app.motion.compared_run import worst
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import SUFFIX
from rotemina.app.recorded_events import Severity, timeline_events
from rotemina.app.records.entry import Entry, WorstGap
from rotemina.sim.comparison.gap import gap_figure, moving
from rotemina.sim.errors import InputError
from rotemina.sim.records.fields import is_comment, is_empty, named_separator, split_fields
from rotemina.sim.records.file_blocks import Limits, open_blocks
from rotemina.sim.records.layout import header_separator, looks_like_header, split_headings
from rotemina.sim.records.metadata import Comments
from rotemina.sim.records.record import Record, Tap

_END_BYTES = 65_536  # of a file's begin and its end that are digested
_BLOCK = Limits(block_bytes=1_000_000)
_MOST_SAMPLES = 300_000  # of a recording whose gap is worked out: five minutes at 1 kHz
_FROM_METADATA = ("robot", "driver", "model", "effects", "run", "operator", "sample")
_PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "µs": 1e6}


def digest(path: Path) -> str:
    """Return a digest that distinguishes a file: size, beginning and end.

    A compressed file ends with a checksum of all that is in it, a recording begins with an id.

    Raises
    ------
    OSError
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        content = sha256(str(size).encode() + file.read(_END_BYTES))
        file.seek(max(size - _END_BYTES, 0))
        content.update(file.read(_END_BYTES))
    return content.hexdigest()[:32]


def with_facts(entry: Entry) -> Entry:
    """Return an entry with the facts of its file; an unreadable file becomes a problem.

    Raises
    ------
    OSError
        If the file is not there, or cannot be read at all.
    """
    about = entry.path.stat()
    entry = replace(
        entry, size=about.st_size, stamp=about.st_mtime_ns, digest=digest(entry.path), problem=""
    )
    try:
        told = _of_recording if entry.path.suffix == SUFFIX else _of_text
        return replace(entry, **told(entry.path))
    except (InputError, KeyError, ValueError) as error:
        return replace(entry, problem=str(error), duration_s=None, gap=None)


def of_metadata(metadata: Mapping[str, str]) -> dict[str, Any]:
    """Return the facts among a record's metadata."""
    told: dict[str, Any] = {key: metadata.get(key, "") for key in _FROM_METADATA}
    return told | {
        "began": moment(metadata.get("began", "")),
        "machine": metadata.get("robot_sha256", ""),
    }


def of_record(record: Record) -> dict[str, Any]:
    """Return the facts of a record that is in memory."""
    return of_metadata(record.metadata) | {"duration_s": record.duration_s}


def _of_recording(path: Path) -> dict[str, Any]:
    recording = Recording.open(path)
    told = timeline_events(recording.events(), recording.began_s)
    return of_metadata(recording.metadata) | {
        "duration_s": recording.ended_s - recording.began_s,
        "events": sum(one.weight is not Severity.DETAIL for one in told),
        "gap": _gap_of(recording),
    }


def _gap_of(recording: Recording) -> WorstGap | None:
    """Return the gap over all that moved in a recording; None in a very long one."""
    if not 0 < recording.count <= _MOST_SAMPLES:
        return None
    samples = recording.samples()
    counted = moving(samples.host_time_s, samples.command)
    figures = {
        (axis, Tap.MEAS): gap_figure(counted, samples.measured[:, column], samples.model[:, column])
        for column, axis in enumerate(recording.axes)
    }
    found = worst(figures, recording.robot)
    if found is None:
        return None
    axis, figure = found
    return WorstGap(axis, figure.rms, recording.units[axis])


def _of_text(path: Path) -> dict[str, Any]:
    """Read metadata, first and last time of a text record, block by block."""
    comments, heading, first, last = Comments(), "", "", ""
    with open_blocks(path, _BLOCK) as blocks:
        for block in blocks:
            if not first:
                for number, line in enumerate(_lines(block.data), start=block.first_line):
                    if line.startswith("#"):
                        comments.add(line, f"{path}:{number}")
                    elif is_empty(line) or is_comment(line) or named_separator(line):
                        continue
                    elif not heading:
                        heading = line
                    else:
                        first = line
                        break
            rows = (line for line in reversed(_lines(block.data[-_END_BYTES:])))
            last = next((row for row in rows if not is_empty(row) and not is_comment(row)), last)
    return of_metadata(comments.metadata) | {"duration_s": _duration_s(heading, first, last)}


def _lines(data: bytes) -> list[str]:
    return data.decode("utf-8", "replace").splitlines()


def _duration_s(heading: str, first: str, last: str) -> float | None:
    """Return the time between two rows; None where the header does not name it as ours do."""
    if not looks_like_header(heading):
        return None
    separator = header_separator(heading)
    name, _, unit = split_headings(heading, separator)[0].partition("[")
    per_s = _PER_SECOND.get(unit.strip(" ]"))
    if name.strip() != "t" or per_s is None:
        return None
    times = [split_fields(row, separator)[0] for row in (first, last) if row]
    begin, end = (float(each.replace(",", ".")) for each in (times[0], times[-1]))
    return (end - begin) / per_s


def moment(text: str) -> datetime | None:
    """Return the time in the metadata, with its offset, or None."""
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        return None
    return moment if moment.tzinfo is not None else moment.astimezone()
