"""Reader of recordings: samples, events and channels by host time, read on demand."""

import json
import mmap
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Any, BinaryIO, Self

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped,unused-ignore] # it comes without types

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording.arrow_tables import (
    AXIS_SIGNALS,
    CHANNEL_PREFIX,
    EVENTS_SCHEMA,
    EVENTS_TABLE,
    FORMAT_KEY,
    FORMAT_VERSION,
    SAMPLES_TABLE,
    TIME_COLUMN,
    make_channel_schema,
    make_samples_schema,
    read_table_name,
)
from rotemina.app.motion.recording.backlog import RecordedEvent
from rotemina.app.motion.recording.recovery import UNFINISHED_SUFFIX
from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.errors import describe_exception
from rotemina.sim.files import open_file
from rotemina.sim.messages import marked
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import parse_robot

_REQUIRED_METADATA_KEYS = ("id", "began_s", "units")


@dataclass(frozen=True, slots=True, eq=False)
class RecordedSamples:
    """Samples of one machine; the arrays are read-only.

    Attributes
    ----------
    axes : tuple of str
        Names of the columns.
    host_time_s : (n,)
        Host time, not decreasing.
    device_time_s : (n,)
        Device time, increasing within a ``connection``. Times of different connections cannot be
        compared.
    connection, playback_row : (n,) int64
        Number of the connection, which increases with each connection to the device; and the row of
        the played trajectory that is in effect, or -1.
    command, inputs, model, measured : (n, axes)
        Command, model output and sensor reading in m or rad, inputs in V. Missing inputs and model
        outputs are NaN.
    """

    axes: tuple[str, ...]
    host_time_s: FloatArray
    device_time_s: FloatArray
    connection: IntArray
    playback_row: IntArray
    command: FloatArray
    inputs: FloatArray
    model: FloatArray
    measured: FloatArray

    def __len__(self) -> int:
        return len(self.host_time_s)

    def select_rows(self, rows: slice) -> Self:
        """Return the samples in a slice of the rows."""
        arrays = {name: getattr(self, name)[rows] for name in self.__slots__ if name != "axes"}
        return replace(self, **arrays)


class Recording:
    """A finished recording. The file is memory-mapped, so only requested data are read.

    All times are times of the host's monotonic clock during the recording, s.
    """

    def __init__(self, path: Path, tables: Mapping[str, pa.Table]) -> None:
        self.path = path
        samples = tables[SAMPLES_TABLE]
        self.metadata: Mapping[str, str] = MappingProxyType(
            {key.decode(): value.decode() for key, value in samples.schema.metadata.items()}
        )
        self.units: Mapping[str, str] = MappingProxyType(json.loads(self.metadata["units"]))
        self.axes = tuple(self.units)
        self._tables = tables
        self._batches: list[pa.RecordBatch] = [
            batch for batch in samples.to_batches() if len(batch)
        ]
        self._batch_begins_s = np.array([_read_time(batch)[0] for batch in self._batches])
        self._batch_ends_s = np.array([_read_time(batch)[-1] for batch in self._batches])

    @classmethod
    def open(cls, path: Path) -> Self:
        """Open a recording.

        Raises
        ------
        RecordingError
            If the file cannot be read, is not a recording, is truncated, or has another version.
        """
        if path.suffix == UNFINISHED_SUFFIX:
            raise RecordingError("{path}: the recording is unfinished; recover it first", path=path)
        try:
            with open_file(
                path, RecordingError, advice=marked("engine", "name a recording")
            ) as file:
                tables = _read_tables(file)
            _check_tables(path, tables)
            return cls(path, tables)
        except RecordingError:
            raise
        # Arrow raises errors of many kinds for damaged bytes.
        except (pa.ArrowException, OSError, ValueError, KeyError, TypeError) as error:
            raise RecordingError(
                "{path}: not a recording of this program, or damaged ({error})",
                path=path,
                error=describe_exception(error),
            ) from error

    @property
    def robot(self) -> Robot:
        """The robot that the recording's robot file describes.

        Raises
        ------
        RobotFileError
            If this program cannot read the robot file.
        """
        return parse_robot(self.metadata.get("robot_file", ""), f"{self.path}: robot file")

    @property
    def began_s(self) -> float:
        """Host time at which the recording began, s."""
        return float(self.metadata["began_s"])

    @cached_property
    def ended_s(self) -> float:
        """Latest host time in any table, s."""
        times_s = [table[TIME_COLUMN].to_numpy() for table in self._tables.values() if len(table)]
        return max([self.began_s, *(float(time_s.max()) for time_s in times_s)])

    @property
    def channels(self) -> tuple[str, ...]:
        """Names of the channels."""
        return tuple(
            name.removeprefix(CHANNEL_PREFIX)
            for name in self._tables
            if name.startswith(CHANNEL_PREFIX)
        )

    @property
    def count(self) -> int:
        """Number of samples."""
        return len(self._tables[SAMPLES_TABLE])

    def read_samples(self, begin_s: float = -np.inf, end_s: float = np.inf) -> RecordedSamples:
        """Return the samples between two host times, both included."""
        batches = list(self._find_batches(begin_s, end_s))
        schema = self._tables[SAMPLES_TABLE].schema
        return self._to_samples(pa.Table.from_batches(batches, schema))

    def read_pieces(
        self, begin_s: float = -np.inf, end_s: float = np.inf, *, max_rows: int | None = None
    ) -> Iterator[RecordedSamples]:
        """Yield the samples in non-empty pieces; with ``max_rows``, only the last rows."""
        for batch in _take_last_rows(list(self._find_batches(begin_s, end_s)), max_rows):
            yield self._to_samples(pa.Table.from_batches([batch]))

    def read_events(
        self, begin_s: float = -np.inf, end_s: float = np.inf
    ) -> tuple[RecordedEvent, ...]:
        """Return the events between two host times, oldest first."""
        table = self._tables.get(EVENTS_TABLE)
        if table is None:
            return ()
        events = [RecordedEvent(*row.values()) for row in table.to_pylist()]
        selected_events = (event for event in events if begin_s <= event.host_time_s <= end_s)
        return tuple(sorted(selected_events, key=lambda event: event.host_time_s))

    def read_channel(
        self, name: str, begin_s: float = -np.inf, end_s: float = np.inf
    ) -> dict[str, FloatArray]:
        """Return the columns (n,) of a channel, sorted by ``host_time_s``, which comes first.

        Raises
        ------
        KeyError
            If there is no such channel.
        """
        table = self._tables[CHANNEL_PREFIX + name]
        time_s = table[TIME_COLUMN].to_numpy()
        order = np.argsort(time_s, kind="stable")
        rows = order[(time_s[order] >= begin_s) & (time_s[order] <= end_s)]
        return {column: table[column].to_numpy()[rows] for column in table.column_names}

    def _find_batches(self, begin_s: float, end_s: float) -> Iterator[pa.RecordBatch]:
        first = int(np.searchsorted(self._batch_ends_s, begin_s))
        last = int(np.searchsorted(self._batch_begins_s, end_s, side="right"))
        for batch in self._batches[first:last]:
            time_s = _read_time(batch)
            low = int(np.searchsorted(time_s, begin_s))
            high = int(np.searchsorted(time_s, end_s, side="right"))
            if high > low:
                yield batch.slice(low, high - low)

    def _to_samples(self, table: pa.Table) -> RecordedSamples:
        signals = []
        for signal in AXIS_SIGNALS:
            values = np.empty((len(table), len(self.axes)))
            for column, axis in enumerate(self.axes):
                values[:, column] = table[f"{axis}.{signal}"].to_numpy()
            values.flags.writeable = False
            signals.append(values)
        command, inputs, model, measured = signals
        return RecordedSamples(
            self.axes,
            _to_array(table, TIME_COLUMN),
            _to_array(table, "device_time_s"),
            _to_array(table, "connection"),
            _to_array(table, "playback_row"),
            command,
            inputs,
            model,
            measured,
        )


def _take_last_rows(batches: list[pa.RecordBatch], max_rows: int | None) -> list[pa.RecordBatch]:
    surplus = 0 if max_rows is None else sum(map(len, batches)) - max_rows
    last_batches = []
    for batch in batches:
        if len(batch) > surplus:
            last_batches.append(batch.slice(max(surplus, 0)))
        surplus -= len(batch)
    return last_batches


def _to_array(table: pa.Table, column: str) -> Any:
    array = table[column].to_numpy().view()
    array.flags.writeable = False
    return array


def _read_time(batch: pa.RecordBatch) -> FloatArray:
    time_s: FloatArray = batch.column(TIME_COLUMN).to_numpy()
    return time_s


def _read_tables(file: BinaryIO) -> dict[str, pa.Table]:
    mapped_file = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    tables = {}
    with pa.BufferReader(pa.py_buffer(mapped_file)) as streams:
        while streams.tell() < streams.size():
            table = pa.ipc.open_stream(streams).read_all()
            # Without this check, damaged text lengths can crash the program.
            table.validate(full=True)
            tables[read_table_name(table.schema)] = table
    return tables


def _check_tables(path: Path, tables: Mapping[str, pa.Table]) -> None:
    schema = tables[SAMPLES_TABLE].schema if SAMPLES_TABLE in tables else None
    metadata = {} if schema is None else schema.metadata or {}
    version = metadata.get(FORMAT_KEY.encode())
    if version is None:
        raise RecordingError("{path}: not a recording of this program", path=path)
    if version != FORMAT_VERSION.encode():
        raise RecordingError(
            "{path}: recording of version {decode}, but this program reads version {version}",
            path=path,
            decode=version.decode("ascii", "replace"),
            version=FORMAT_VERSION,
        )
    missing = [key for key in _REQUIRED_METADATA_KEYS if key.encode() not in metadata]
    if missing:
        raise RecordingError(
            "{path}: damaged, {names} missing", path=path, names=", ".join(missing)
        )
    if not np.isfinite(float(metadata[b"began_s"])):
        raise RecordingError(
            "{path}: damaged, began_s is {about}", path=path, about=repr(metadata[b"began_s"])
        )
    schemas = {
        SAMPLES_TABLE: make_samples_schema(json.loads(metadata[b"units"])),
        EVENTS_TABLE: EVENTS_SCHEMA,
    }
    for name, table in tables.items():
        expected_schema = schemas.get(name) or make_channel_schema(name, table.column_names)
        if not table.schema.equals(expected_schema) or any(
            column.null_count for column in table.columns
        ):
            raise RecordingError(
                "{path}: damaged, {name} is not a table of a recording",
                path=path,
                name=repr(name[:40]),
            )
