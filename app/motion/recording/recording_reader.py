"""Access to recordings: samples, events and channels by host time, read on demand."""

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

from rotemina.app.motion.recording.arrow_tables import (
    CHANNEL,
    EVENTS,
    EVENTS_SCHEMA,
    FORMAT,
    SAMPLES,
    SIGNALS,
    TIME,
    VERSION,
    channel_schema,
    name_of,
    samples_schema,
)
from rotemina.app.motion.recording.backlog import RecordedEvent
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recovery import UNFINISHED
from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.errors import reason_of
from rotemina.sim.input_files import open_file
from rotemina.sim.messages import marked, message
from rotemina.sim.robot.file import parse_robot
from rotemina.sim.robot.model import Robot

_WRITTEN = ("id", "began_s", "units")


@dataclass(frozen=True, slots=True, eq=False)
class RecordedSamples:
    """A section of samples of one machine; the arrays are read-only.

    Attributes
    ----------
    axes : tuple of str
        What the columns are.
    host_time_s : (n,)
        Not decreasing.
    device_time_s : (n,)
        Increasing within a ``connection``; not to be compared with times of another.
    connection, playback_row : (n,) int64
        Counts up with each connection to the device; the row of a trajectory that began, or -1.
    command, inputs, model, measured : (n, axes)
        m or rad, and V; inputs and model are NaN where there are none.
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

    def part(self, rows: slice) -> Self:
        """Return some of them."""
        arrays = {name: getattr(self, name)[rows] for name in self.__slots__ if name != "axes"}
        return replace(self, **arrays)


class Recording:
    """A finished recording. The file is mapped: only requested data are read from the disk.

    Times are those of the host's monotonic clock, s, as recorded.
    """

    def __init__(self, path: Path, tables: Mapping[str, pa.Table]) -> None:
        self.path = path
        samples = tables[SAMPLES]
        self.metadata: Mapping[str, str] = MappingProxyType(
            {key.decode(): value.decode() for key, value in samples.schema.metadata.items()}
        )
        self.units: Mapping[str, str] = MappingProxyType(json.loads(self.metadata["units"]))
        self.axes = tuple(self.units)
        self._tables = tables
        self._batches: list[pa.RecordBatch] = [one for one in samples.to_batches() if len(one)]
        self._begins_s = np.array([_time(one)[0] for one in self._batches])
        self._ends_s = np.array([_time(one)[-1] for one in self._batches])

    @classmethod
    def open(cls, path: Path) -> Self:
        """Open a recording.

        Raises
        ------
        RecordingError
            If it cannot be read, is no recording, was cut off, or is of another version.
        """
        if path.suffix == UNFINISHED:
            raise RecordingError(
                message("engine", "{path}: the recording is unfinished; recover it first").fill(
                    path=path
                )
            )
        try:
            with open_file(
                path, RecordingError, advice=marked("engine", "name a recording")
            ) as file:
                tables = _tables(file)
            _check(path, tables)
            return cls(path, tables)
        except RecordingError:
            raise
        # Arrow's errors are of many kinds, and so is what it makes of damaged bytes.
        except (pa.ArrowException, OSError, ValueError, KeyError, TypeError) as error:
            raise RecordingError(
                message(
                    "engine", "{path}: not a recording of this program, or damaged ({error})"
                ).fill(path=path, error=reason_of(error))
            ) from error

    @property
    def robot(self) -> Robot:
        """The machine, as its robot file said.

        Raises
        ------
        RobotFileError
            If this program cannot read that.
        """
        return parse_robot(self.metadata.get("robot_file", ""), f"{self.path}: robot file")

    @property
    def began_s(self) -> float:
        """When the recording began."""
        return float(self.metadata["began_s"])

    @cached_property
    def ended_s(self) -> float:
        """The latest time that anything in it has."""
        tables = [table[TIME].to_numpy() for table in self._tables.values() if len(table)]
        return max([self.began_s, *(float(each.max()) for each in tables)])

    @property
    def channels(self) -> tuple[str, ...]:
        """Names of the further channels."""
        return tuple(
            name.removeprefix(CHANNEL) for name in self._tables if name.startswith(CHANNEL)
        )

    @property
    def count(self) -> int:
        """How many samples it holds."""
        return len(self._tables[SAMPLES])

    def samples(self, begin_s: float = -np.inf, end_s: float = np.inf) -> RecordedSamples:
        """Return the samples from one host time to another, both included."""
        batches = list(self._within(begin_s, end_s))
        schema = self._tables[SAMPLES].schema
        return self._samples(pa.Table.from_batches(batches, schema))

    def pieces(
        self, begin_s: float = -np.inf, end_s: float = np.inf, *, most: int | None = None
    ) -> Iterator[RecordedSamples]:
        """Give the same samples piece by piece, none of them empty; at ``most`` the last ones."""
        for batch in _last(list(self._within(begin_s, end_s)), most):
            yield self._samples(pa.Table.from_batches([batch]))

    def events(self, begin_s: float = -np.inf, end_s: float = np.inf) -> tuple[RecordedEvent, ...]:
        """Return the events from one host time to another, oldest first."""
        table = self._tables.get(EVENTS)
        if table is None:
            return ()
        found = [RecordedEvent(*row.values()) for row in table.to_pylist()]
        within = (one for one in found if begin_s <= one.host_time_s <= end_s)
        return tuple(sorted(within, key=lambda one: one.host_time_s))

    def channel(
        self, name: str, begin_s: float = -np.inf, end_s: float = np.inf
    ) -> dict[str, FloatArray]:
        """Return the columns (n,) of a channel, ``host_time_s`` first and increasing.

        Raises
        ------
        KeyError
            If there is no such channel.
        """
        table = self._tables[CHANNEL + name]
        time_s = table[TIME].to_numpy()
        order = np.argsort(time_s, kind="stable")
        rows = order[(time_s[order] >= begin_s) & (time_s[order] <= end_s)]
        return {column: table[column].to_numpy()[rows] for column in table.column_names}

    def _within(self, begin_s: float, end_s: float) -> Iterator[pa.RecordBatch]:
        first = int(np.searchsorted(self._ends_s, begin_s))
        last = int(np.searchsorted(self._begins_s, end_s, side="right"))
        for batch in self._batches[first:last]:
            time_s = _time(batch)
            low = int(np.searchsorted(time_s, begin_s))
            high = int(np.searchsorted(time_s, end_s, side="right"))
            if high > low:
                yield batch.slice(low, high - low)

    def _samples(self, table: pa.Table) -> RecordedSamples:
        taps = []
        for signal in SIGNALS:
            values = np.empty((len(table), len(self.axes)))
            for column, axis in enumerate(self.axes):
                values[:, column] = table[f"{axis}.{signal}"].to_numpy()
            values.flags.writeable = False
            taps.append(values)
        command, inputs, model, measured = taps
        return RecordedSamples(
            self.axes,
            _array(table, TIME),
            _array(table, "device_time_s"),
            _array(table, "connection"),
            _array(table, "playback_row"),
            command,
            inputs,
            model,
            measured,
        )


def _last(batches: list[pa.RecordBatch], most: int | None) -> list[pa.RecordBatch]:
    """Return the last rows of batches, as batches."""
    surplus = 0 if most is None else sum(map(len, batches)) - most
    kept = []
    for batch in batches:
        if len(batch) > surplus:
            kept.append(batch.slice(max(surplus, 0)))
        surplus -= len(batch)
    return kept


def _array(table: pa.Table, column: str) -> Any:
    """Return a column as an array of its own type, read-only."""
    array = table[column].to_numpy().view()
    array.flags.writeable = False
    return array


def _time(batch: pa.RecordBatch) -> FloatArray:
    time_s: FloatArray = batch.column(TIME).to_numpy()
    return time_s


def _tables(file: BinaryIO) -> dict[str, pa.Table]:
    """Return the tables of a mapped file by name."""
    mapped = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    found = {}
    with pa.BufferReader(pa.py_buffer(mapped)) as streams:
        while streams.tell() < streams.size():
            table = pa.ipc.open_stream(streams).read_all()
            table.validate(full=True)  # or damaged lengths of text end the program
            found[name_of(table.schema)] = table
    return found


def _check(path: Path, tables: Mapping[str, pa.Table]) -> None:
    """Refuse files that this program did not write, and damaged ones."""
    schema = tables[SAMPLES].schema if SAMPLES in tables else None
    about = {} if schema is None else schema.metadata or {}
    version = about.get(FORMAT.encode())
    if version is None:
        raise RecordingError(
            message("engine", "{path}: not a recording of this program").fill(path=path)
        )
    if version != VERSION.encode():
        raise RecordingError(
            message(
                "engine",
                "{path}: recording of version {decode}, but this program reads version {version}",
            ).fill(path=path, decode=version.decode("ascii", "replace"), version=VERSION)
        )
    lost = [key for key in _WRITTEN if key.encode() not in about]
    if lost:
        raise RecordingError(
            message("engine", "{path}: damaged, {names} missing").fill(
                path=path, names=", ".join(lost)
            )
        )
    if not np.isfinite(float(about[b"began_s"])):
        raise RecordingError(
            message("engine", "{path}: damaged, began_s is {about}").fill(
                path=path, about=repr(about[b"began_s"])
            )
        )
    known = {SAMPLES: samples_schema(json.loads(about[b"units"])), EVENTS: EVENTS_SCHEMA}
    for name, table in tables.items():
        wanted = known.get(name) or channel_schema(name, table.column_names)
        if not table.schema.equals(wanted) or any(column.null_count for column in table.columns):
            raise RecordingError(
                message("engine", "{path}: damaged, {name} is not a table of a recording").fill(
                    path=path, name=repr(name[:40])
                )
            )
