"""Merges the segments of a recording into one file, at its end or after a crash."""

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped,unused-ignore] # it comes without types

from rotemina.app.motion.recording.arrow_tables import (
    EVENTS,
    FORMAT,
    SAMPLES,
    VERSION,
    name_of,
    samples_schema,
)
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.segments import ByteRange, WholeSegments, locked
from rotemina.sim.messages import message
from rotemina.sim.whole_files import FileWriteError, replaced

SUFFIX, UNFINISHED = ".arrows", ".part"
_ROWS = 65_536  # of a batch, at least: what a reader takes at a time


def recover(path: Path) -> Path:
    """Complete the recording that a crash left in ``path``; return the finished file.

    Raises
    ------
    RecordingError
        If it is none, is being recorded, holds nothing, or there is no room; it stays then.
    """
    if path.suffix != UNFINISHED:
        raise RecordingError(
            message(
                "engine", "{path}: the name of an interrupted recording ends with {unfinished}"
            ).fill(path=path, unfinished=UNFINISHED)
        )
    return merged(path, path.with_suffix(""))


def unfinished(folder: Path) -> tuple[Path, ...]:
    """Return what recordings were left in a folder, those that are being recorded among them."""
    return tuple(sorted(folder.glob(f"*{SUFFIX}{UNFINISHED}")))


def being_recorded(path: Path) -> bool:
    """Return whether a program is recording or recovering ``path``."""
    try:
        with path.open("r+b") as file:
            return not locked(file)
    except OSError:  # it is gone, or nobody here may write it: recovering says so
        return False


def merged(source: Path, target: Path) -> Path:
    """Merge segments into one file and delete them once the disk has it; return the file.

    The finished file is Arrow streams one behind the other, one for each table, samples first. One
    batch at a time is in memory.

    Raises
    ------
    RecordingError
        As :func:`recover`.
    """
    with WholeSegments(source) as segments:
        metadata, tables = _contents(source, segments)
        if target.exists():
            _check_same(source, target, metadata)
        else:
            try:
                with replaced(target) as file:
                    for name, table in tables.items():
                        schema = table.schema.with_metadata({"table": name, **metadata})
                        _merge(segments, table, schema, file)
            except FileWriteError as error:
                raise RecordingError(
                    message("engine", "{error}; the recorded data are in {source}").fill(
                        error=str(error), source=source
                    )
                ) from error
            _settle(target.parent)
    source.unlink(missing_ok=True)
    return target


class _Table:
    """Where the streams of a table are, and its schema: that of all of them together."""

    def __init__(self, schema: pa.Schema) -> None:
        self.schema = schema
        self.ranges: list[ByteRange] = []

    def add(self, byte_range: ByteRange, schema: pa.Schema) -> None:
        self.ranges.append(byte_range)
        if schema != self.schema:
            self.schema = pa.unify_schemas([self.schema, schema])


def _contents(source: Path, segments: WholeSegments) -> tuple[dict[str, str], dict[str, _Table]]:
    found = iter(segments)
    try:
        metadata = _metadata(source, next(found)[1])
    except StopIteration:
        raise RecordingError(
            message("engine", "{source}: interrupted before anything was recorded; delete it").fill(
                source=source
            )
        ) from None
    tables = {SAMPLES: _Table(samples_schema(json.loads(metadata["units"])))}
    for byte_range, content in found:
        schema = pa.ipc.read_schema(pa.py_buffer(content))
        tables.setdefault(name_of(schema), _Table(schema)).add(byte_range, schema)
    order = sorted(tables, key=lambda name: (name != SAMPLES, name != EVENTS, name))
    return metadata, {name: tables[name] for name in order}


def _metadata(source: Path, content: bytes) -> dict[str, str]:
    metadata: dict[str, str] = json.loads(content)
    if metadata.get(FORMAT) != VERSION:
        raise RecordingError(
            message(
                "engine",
                "{source}: version {get}, but this program reads version {version}; recover "
                "it with the program that recorded it",
            ).fill(source=source, get=str(metadata.get(FORMAT)), version=VERSION)
        )
    return metadata


def _check_same(source: Path, target: Path, metadata: Mapping[str, str]) -> None:
    """Accept that the merge was done already, and only the segments were still to be deleted."""
    try:
        with target.open("rb") as file:
            there = pa.ipc.open_stream(file).schema.metadata or {}
    except (OSError, pa.ArrowInvalid):
        there = {}
    if there.get(b"id") != metadata["id"].encode():
        raise RecordingError(
            message(
                "engine",
                "{target} already exists and is another recording; rename it, then recover "
                "{source}",
            ).fill(target=target, source=source)
        )


def _merge(segments: WholeSegments, table: _Table, schema: pa.Schema, file: BinaryIO) -> None:
    with pa.ipc.new_stream(file, schema) as writer:
        waiting: list[pa.RecordBatch] = []
        for batch in _batches(segments, table, schema):
            waiting.append(batch)
            if sum(map(len, waiting)) >= _ROWS:
                writer.write_batch(pa.concat_batches(waiting))
                waiting = []
        if waiting:
            writer.write_batch(pa.concat_batches(waiting))


def _batches(segments: WholeSegments, table: _Table, schema: pa.Schema) -> Iterator[pa.RecordBatch]:
    for byte_range in table.ranges:
        with pa.ipc.open_stream(pa.py_buffer(segments.read(byte_range))) as stream:
            for batch in stream:
                columns = [_column(batch, field) for field in schema]
                yield pa.record_batch(columns, schema=schema)


def _column(batch: pa.RecordBatch, field: pa.Field) -> pa.Array:
    """Return a column; NaN if this batch lacks it."""
    if batch.schema.get_field_index(field.name) >= 0:
        return batch.column(field.name)
    return pa.array(np.full(len(batch), np.nan))


def _settle(folder: Path) -> None:
    """Have the disk keep the new name before the old one goes."""
    with suppress(OSError):  # not every system opens folders
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
