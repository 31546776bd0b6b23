"""Merges the segments of a recording into one file, at its end or after a crash."""

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped,unused-ignore] # it comes without types

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording.arrow_tables import (
    EVENTS_TABLE,
    FORMAT_KEY,
    FORMAT_VERSION,
    SAMPLES_TABLE,
    make_samples_schema,
    read_table_name,
)
from rotemina.app.motion.recording.segments import ByteRange, SegmentReader, try_lock
from rotemina.sim.errors import FileWriteError
from rotemina.sim.files import replace_file

RECORDING_SUFFIX, UNFINISHED_SUFFIX = ".arrows", ".part"
# Readers take one batch at a time, so small batches are joined to at least this size.
_MIN_BATCH_ROWS = 65_536


def recover_recording(path: Path) -> Path:
    """Complete the recording that a crash left in ``path``; return the finished file.

    Raises
    ------
    RecordingError
        If ``path`` is not an interrupted recording, is being recorded or is empty, or if the disk
        is full. The file is then kept.
    """
    if path.suffix != UNFINISHED_SUFFIX:
        raise RecordingError(
            "{path}: the name of an interrupted recording ends with {unfinished}",
            path=path,
            unfinished=UNFINISHED_SUFFIX,
        )
    return merge_segments(path, path.with_suffix(""))


def find_unfinished(folder: Path) -> tuple[Path, ...]:
    """Return the unfinished recordings in a folder, including those that are being recorded."""
    return tuple(sorted(folder.glob(f"*{RECORDING_SUFFIX}{UNFINISHED_SUFFIX}")))


def is_being_recorded(path: Path) -> bool:
    """Return whether a program is recording or recovering ``path``."""
    try:
        with path.open("r+b") as file:
            return not try_lock(file)
    # The file is gone or not writable, which an attempt to recover it will report.
    except OSError:
        return False


def merge_segments(source: Path, target: Path) -> Path:
    """Merge segments into one file, delete them once the file is on the disk, and return it.

    The finished file consists of consecutive Arrow streams, one for each table, samples first. Only
    one batch at a time is in memory.

    Raises
    ------
    RecordingError
        See :func:`recover_recording`.
    """
    with SegmentReader(source) as segments:
        metadata, tables = _read_contents(source, segments)
        if target.exists():
            _check_same_recording(source, target, metadata)
        else:
            try:
                with replace_file(target) as file:
                    for name, table in tables.items():
                        schema = table.schema.with_metadata({"table": name, **metadata})
                        _merge_table(segments, table, schema, file)
            except FileWriteError as error:
                raise RecordingError(
                    "{error}; the recorded data are in {source}", error=str(error), source=source
                ) from error
            _sync_folder(target.parent)
    source.unlink(missing_ok=True)
    return target


class _TableSegments:
    def __init__(self, schema: pa.Schema) -> None:
        self.schema = schema
        self.ranges: list[ByteRange] = []

    def add(self, byte_range: ByteRange, schema: pa.Schema) -> None:
        self.ranges.append(byte_range)
        if schema != self.schema:
            self.schema = pa.unify_schemas([self.schema, schema])


def _read_contents(
    source: Path, segments: SegmentReader
) -> tuple[dict[str, str], dict[str, _TableSegments]]:
    remaining_segments = iter(segments)
    try:
        metadata = _read_metadata(source, next(remaining_segments)[1])
    except StopIteration:
        raise RecordingError(
            "{source}: interrupted before anything was recorded; delete it", source=source
        ) from None
    tables = {SAMPLES_TABLE: _TableSegments(make_samples_schema(json.loads(metadata["units"])))}
    for byte_range, content in remaining_segments:
        schema = pa.ipc.read_schema(pa.py_buffer(content))
        tables.setdefault(read_table_name(schema), _TableSegments(schema)).add(byte_range, schema)
    order = sorted(tables, key=lambda name: (name != SAMPLES_TABLE, name != EVENTS_TABLE, name))
    return metadata, {name: tables[name] for name in order}


def _read_metadata(source: Path, content: bytes) -> dict[str, str]:
    metadata: dict[str, str] = json.loads(content)
    if metadata.get(FORMAT_KEY) != FORMAT_VERSION:
        raise RecordingError(
            "{source}: version {get}, but this program reads version {version}; recover "
            "it with the program that recorded it",
            source=source,
            get=str(metadata.get(FORMAT_KEY)),
            version=FORMAT_VERSION,
        )
    return metadata


def _check_same_recording(source: Path, target: Path, metadata: Mapping[str, str]) -> None:
    """Refuse a target that is another recording.

    If the target is the same recording, a crash has prevented only the deletion of the segments.
    """
    try:
        with target.open("rb") as file:
            target_metadata = pa.ipc.open_stream(file).schema.metadata or {}
    except (OSError, pa.ArrowInvalid):
        target_metadata = {}
    if target_metadata.get(b"id") != metadata["id"].encode():
        raise RecordingError(
            "{target} already exists and is another recording; rename it, then recover {source}",
            target=target,
            source=source,
        )


def _merge_table(
    segments: SegmentReader, table: _TableSegments, schema: pa.Schema, file: BinaryIO
) -> None:
    with pa.ipc.new_stream(file, schema) as writer:
        pending_batches: list[pa.RecordBatch] = []
        for batch in _read_batches(segments, table, schema):
            pending_batches.append(batch)
            if sum(map(len, pending_batches)) >= _MIN_BATCH_ROWS:
                writer.write_batch(pa.concat_batches(pending_batches))
                pending_batches = []
        if pending_batches:
            writer.write_batch(pa.concat_batches(pending_batches))


def _read_batches(
    segments: SegmentReader, table: _TableSegments, schema: pa.Schema
) -> Iterator[pa.RecordBatch]:
    for byte_range in table.ranges:
        with pa.ipc.open_stream(pa.py_buffer(segments.read(byte_range))) as stream:
            for batch in stream:
                columns = [_find_column(batch, field) for field in schema]
                yield pa.record_batch(columns, schema=schema)


def _find_column(batch: pa.RecordBatch, field: pa.Field) -> pa.Array:
    """Return a column, filled with NaN if this batch lacks it."""
    if batch.schema.get_field_index(field.name) >= 0:
        return batch.column(field.name)
    return pa.array(np.full(len(batch), np.nan))


def _sync_folder(folder: Path) -> None:
    """Wait until the disk has stored the new file's name, so that the segments can be deleted."""
    # Some systems cannot open folders.
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
