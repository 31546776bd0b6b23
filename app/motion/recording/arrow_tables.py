"""The Arrow tables of a recording, and the conversion of entries to table rows."""

import json
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped,unused-ignore] # it comes without types

from rotemina.app.motion.recording.backlog import (
    BacklogEntry,
    ChannelRow,
    RecordedEvent,
    SampleBlock,
)
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot import Robot

FORMAT_KEY = "rotemina-recording"
FORMAT_VERSION = "1"
SAMPLES_TABLE, EVENTS_TABLE, CLOCK_CHANNEL = "samples", "events", "clock"
# The names of all tables except samples and events begin with this.
CHANNEL_PREFIX = "channel:"
TIME_COLUMN = "host_time_s"
AXIS_SIGNALS = ("cmd", "u", "model", "meas")

_TABLE_NAME_KEY = b"table"
EVENTS_SCHEMA = pa.schema(
    [
        pa.field(TIME_COLUMN, pa.float64(), metadata={"unit": "s"}),
        ("kind", pa.string()),
        ("text", pa.string()),
        ("details", pa.string()),
    ],
    metadata={_TABLE_NAME_KEY: EVENTS_TABLE},
)


def make_samples_schema(units: Mapping[str, str]) -> pa.Schema:
    """Return the schema of the samples table, given the unit (m or rad) of each axis."""
    fields = [
        pa.field(TIME_COLUMN, pa.float64(), metadata={"unit": "s"}),
        pa.field("device_time_s", pa.float64(), metadata={"unit": "s"}),
        pa.field("connection", pa.int64()),
        pa.field("playback_row", pa.int64()),
    ]
    for axis, unit in units.items():
        for signal in AXIS_SIGNALS:
            metadata = {"unit": "V" if signal == "u" else unit}
            fields.append(pa.field(f"{axis}.{signal}", pa.float64(), metadata=metadata))
    return pa.schema(fields, metadata={_TABLE_NAME_KEY: SAMPLES_TABLE})


def make_channel_schema(name: str, columns: Sequence[str]) -> pa.Schema:
    """Return the schema of a channel's table; the first of the ``columns`` is the time."""
    fields = [(column, pa.float64()) for column in (TIME_COLUMN, *columns[1:])]
    return pa.schema(fields, metadata={_TABLE_NAME_KEY: name})


def find_axis_units(robot: Robot) -> dict[str, str]:
    """Return the unit of each axis, m or rad; m if the robot file does not state it."""
    return {axis: robot.unit(axis) or "m" for axis in robot.axes}


def read_table_name(schema: pa.Schema) -> str:
    """Return the name of the table to which a stream belongs."""
    name: bytes = (schema.metadata or {}).get(_TABLE_NAME_KEY, b"")
    return name.decode()


def encode_header(metadata: Mapping[str, str]) -> bytes:
    """Return the content of the first segment: the metadata of the whole recording."""
    return json.dumps({FORMAT_KEY: FORMAT_VERSION, **metadata}).encode()


def load_arrow() -> None:
    """Encode empty tables, so that Arrow loads its modules now and not during the recording."""
    samples = DeviceSamples.empty(1)
    block = SampleBlock(0, np.empty(0), samples, samples.command)
    encode_streams(
        [block, RecordedEvent(0.0, "", ""), ChannelRow("", 0.0, {})],
        make_samples_schema({"x": "m"}),
    )


def encode_streams(entries: Iterable[BacklogEntry], schema: pa.Schema) -> list[bytes]:
    """Return the entries as Arrow streams, one for each table that gets new rows.

    ``schema`` is the schema of the samples table.
    """
    blocks: list[SampleBlock] = []
    events: list[RecordedEvent] = []
    rows: dict[str, list[ChannelRow]] = {}
    for entry in entries:
        if isinstance(entry, SampleBlock):
            blocks.append(entry)
        elif isinstance(entry, RecordedEvent):
            events.append(entry)
        else:
            rows.setdefault(entry.channel, []).append(entry)
    streams = [_encode_batch(_make_samples_batch(blocks, schema))] if blocks else []
    if events:
        streams.append(_encode_batch(_make_events_batch(events)))
    return streams + [
        _encode_batch(_make_channel_batch(name, channel_rows))
        for name, channel_rows in rows.items()
    ]


def _encode_batch(batch: pa.RecordBatch) -> bytes:
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, batch.schema) as writer:
        writer.write_batch(batch)
    content: bytes = sink.getvalue().to_pybytes()
    return content


def _make_samples_batch(blocks: Sequence[SampleBlock], schema: pa.Schema) -> pa.RecordBatch:
    counts = [len(block.samples) for block in blocks]
    columns = [
        np.concatenate([block.host_time_s for block in blocks]),
        np.concatenate([block.samples.device_time_s for block in blocks]),
        np.repeat(np.array([block.connection for block in blocks]), counts),
        np.concatenate([block.samples.playback_row for block in blocks]),
    ]
    signals = [
        np.ascontiguousarray(np.concatenate(parts).T)
        for parts in (
            [block.samples.command for block in blocks],
            [block.samples.inputs for block in blocks],
            [block.model for block in blocks],
            [block.samples.measured for block in blocks],
        )
    ]
    for axis in range(len(signals[0])):
        columns += [signal[axis] for signal in signals]
    return pa.record_batch([pa.array(column) for column in columns], schema=schema)


def _make_events_batch(events: Sequence[RecordedEvent]) -> pa.RecordBatch:
    rows = [{name: getattr(event, name) for name in EVENTS_SCHEMA.names} for event in events]
    return pa.RecordBatch.from_pylist(rows, schema=EVENTS_SCHEMA)


def _make_channel_batch(name: str, rows: Sequence[ChannelRow]) -> pa.RecordBatch:
    columns = list(dict.fromkeys(key for row in rows for key in row.values))
    arrays: dict[str, FloatArray] = {TIME_COLUMN: np.array([row.host_time_s for row in rows])}
    for column in columns:
        arrays[column] = np.array([row.values.get(column, np.nan) for row in rows], np.float64)
    schema = make_channel_schema(CHANNEL_PREFIX + name, list(arrays))
    return pa.record_batch([pa.array(array) for array in arrays.values()], schema=schema)
