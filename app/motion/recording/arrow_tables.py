"""The Arrow tables of a recording, and the conversion of entries to rows."""

import json
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped,unused-ignore] # it comes without types

from rotemina.app.motion.recording.backlog import Block, Entry, RecordedEvent, Row
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Robot

FORMAT = "rotemina-recording"
VERSION = "1"
SAMPLES, EVENTS, CLOCK = "samples", "events", "clock"
CHANNEL = "channel:"  # before the name of every other table
TIME = "host_time_s"
SIGNALS = ("cmd", "u", "model", "meas")

_NAME = b"table"
EVENTS_SCHEMA = pa.schema(
    [
        pa.field(TIME, pa.float64(), metadata={"unit": "s"}),
        ("kind", pa.string()),
        ("text", pa.string()),
        ("details", pa.string()),
    ],
    metadata={_NAME: EVENTS},
)


def samples_schema(units: Mapping[str, str]) -> pa.Schema:
    """Return the columns of the samples of a machine, by the quantity (m or rad) of each axis."""
    fields = [
        pa.field(TIME, pa.float64(), metadata={"unit": "s"}),
        pa.field("device_time_s", pa.float64(), metadata={"unit": "s"}),
        pa.field("connection", pa.int64()),
        pa.field("playback_row", pa.int64()),
    ]
    for axis, unit in units.items():
        for signal in SIGNALS:
            of = {"unit": "V" if signal == "u" else unit}
            fields.append(pa.field(f"{axis}.{signal}", pa.float64(), metadata=of))
    return pa.schema(fields, metadata={_NAME: SAMPLES})


def channel_schema(name: str, columns: Sequence[str]) -> pa.Schema:
    """Return the schema of a further table; ``columns`` begin with the time."""
    fields = [(column, pa.float64()) for column in (TIME, *columns[1:])]
    return pa.schema(fields, metadata={_NAME: name})


def units_of(robot: Robot) -> dict[str, str]:
    """Return the quantity of each axis; a robot file that leaves it open means a length."""
    return {axis: robot.unit(axis) or "m" for axis in robot.axes}


def name_of(schema: pa.Schema) -> str:
    """Return which table a stream belongs to."""
    name: bytes = (schema.metadata or {}).get(_NAME, b"")
    return name.decode()


def header(metadata: Mapping[str, str]) -> bytes:
    """Return the content of the first segment: what holds for the whole recording."""
    return json.dumps({FORMAT: VERSION, **metadata}).encode()


def prepare() -> None:
    """Make tables once: what Arrow loads when it is first used, pandas among it, takes a while."""
    none = Samples.none(1)
    block = Block(0, np.empty(0), none, none.command)
    streams([block, RecordedEvent(0.0, "", ""), Row("", 0.0, {})], samples_schema({"x": "m"}))


def streams(entries: Iterable[Entry], schema: pa.Schema) -> list[bytes]:
    """Return entries as Arrow streams, one of each table that has news.

    ``schema`` is that of the samples.
    """
    blocks: list[Block] = []
    events: list[RecordedEvent] = []
    rows: dict[str, list[Row]] = {}
    for entry in entries:
        if isinstance(entry, Block):
            blocks.append(entry)
        elif isinstance(entry, RecordedEvent):
            events.append(entry)
        else:
            rows.setdefault(entry.channel, []).append(entry)
    made = [_stream(_samples(blocks, schema))] if blocks else []
    if events:
        made.append(_stream(_events(events)))
    return made + [_stream(_channel(name, each)) for name, each in rows.items()]


def _stream(batch: pa.RecordBatch) -> bytes:
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, batch.schema) as writer:
        writer.write_batch(batch)
    content: bytes = sink.getvalue().to_pybytes()
    return content


def _samples(blocks: Sequence[Block], schema: pa.Schema) -> pa.RecordBatch:
    counts = [len(block.samples) for block in blocks]
    columns = [
        np.concatenate([block.host_time_s for block in blocks]),
        np.concatenate([block.samples.device_time_s for block in blocks]),
        np.repeat(np.array([block.connection for block in blocks]), counts),
        np.concatenate([block.samples.playback_row for block in blocks]),
    ]
    taps = [
        np.ascontiguousarray(np.concatenate(parts).T)
        for parts in (
            [block.samples.command for block in blocks],
            [block.samples.inputs for block in blocks],
            [block.model for block in blocks],
            [block.samples.measured for block in blocks],
        )
    ]
    for axis in range(len(taps[0])):
        columns += [tap[axis] for tap in taps]
    return pa.record_batch([pa.array(column) for column in columns], schema=schema)


def _events(events: Sequence[RecordedEvent]) -> pa.RecordBatch:
    rows = [{name: getattr(one, name) for name in EVENTS_SCHEMA.names} for one in events]
    return pa.RecordBatch.from_pylist(rows, schema=EVENTS_SCHEMA)


def _channel(name: str, rows: Sequence[Row]) -> pa.RecordBatch:
    columns = list(dict.fromkeys(key for row in rows for key in row.values))
    arrays: dict[str, FloatArray] = {TIME: np.array([row.host_time_s for row in rows])}
    for column in columns:
        arrays[column] = np.array([row.values.get(column, np.nan) for row in rows], np.float64)
    schema = channel_schema(CHANNEL + name, list(arrays))
    return pa.record_batch([pa.array(array) for array in arrays.values()], schema=schema)
