"""Writes a recording on its own threads."""

import json
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from pathlib import Path
from statistics import median
from typing import NamedTuple
from uuid import uuid4

import numpy as np

from rotemina.app.errors import RecordingError
from rotemina.app.motion.device import Ticker
from rotemina.app.motion.recording.arrow_tables import (
    CLOCK_CHANNEL,
    encode_header,
    encode_streams,
    load_arrow,
    make_samples_schema,
)
from rotemina.app.motion.recording.backlog import (
    BacklogLoss,
    ChannelRow,
    RecordedEvent,
    RecordingBacklog,
    SampleBlock,
)
from rotemina.app.motion.recording.recovery import UNFINISHED_SUFFIX, merge_segments
from rotemina.app.motion.recording.segments import SegmentFile
from rotemina.app.settings import FileOpener, open_new_file
from rotemina.drivers.contract import Clock, DeviceSamples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import format_fixed, marked, message

# A crash loses at most the data of this period and of the time that writing them takes.
SEGMENT_PERIOD_S = 0.25
# If a disk takes longer than this for a segment, a crash may lose more than the documented second.
SLOW_WRITE_S = 0.7
# Memory for unwritten data: 14 s at 20 kHz and 24 channels, or 5 min at 1 kHz.
BACKLOG_CAPACITY_BYTES = 64_000_000
# The clock is fitted over about eight seconds. In this time a clock with an error of 50 ppm drifts
# by 0.4 ms.
_CLOCK_WINDOW_BATCHES = 512
# Longest time for which ``close`` waits for a disk that does not respond.
_MAX_CLOSE_S = 60.0


class ClockFit(NamedTuple):
    """Offset of a device clock: ``host_time_s`` = device time + ``offset_s``.

    ``uncertainty_s`` is the median delay of the samples behind the fastest ones. It does not
    contain a delay common to all samples, which cannot be distinguished from the offset.
    """

    offset_s: float
    uncertainty_s: float


class DeviceClock:
    """Estimates the offset of a device's clock during one connection.

    No sample arrives before it was taken. The best estimate of the offset is therefore the minimum
    of (host time of arrival) − (device time) over the last seconds.
    """

    def __init__(self) -> None:
        self._delays_s: deque[float] = deque(maxlen=_CLOCK_WINDOW_BATCHES)

    def observe(self, received_s: float, device_time_s: float) -> ClockFit:
        """Add the device time of a sample and the host time of its arrival; return the fit."""
        self._delays_s.append(received_s - device_time_s)
        offset_s = min(self._delays_s)
        return ClockFit(offset_s, median(self._delays_s) - offset_s)


class RecordingWriter:
    """Appends segments to ``PATH.part``, and merges them on close.

    :meth:`add` and :meth:`add_row` may be called from any thread and return at once.
    :meth:`run_once` writes waiting data. :meth:`start` starts two threads that do this: one writes,
    and one waits for the disk.

    If the disk is full or fails, the operator is notified once, and the writer tries the segment
    again in every period. Meanwhile new data wait in memory; data that exceed the capacity are
    lost. When writing succeeds again, an event in the recording reports the loss.

    Parameters
    ----------
    path : Path
        Path of the finished recording.
    units : mapping axis -> "m" or "rad"
        The axes, in the order of the samples' columns.
    metadata : mapping str -> str
        Metadata of the whole recording.
    clock : callable
        Returns the host's monotonic time, s.
    notify : callable
        Called with messages for the operator, on the writer thread.
    capacity_bytes : int
        Capacity for data that wait to be written.
    opener : callable
        Creates the file.

    Raises
    ------
    RecordingError
        If the file exists already or cannot be created.
    """

    def __init__(
        self,
        path: Path,
        units: Mapping[str, str],
        metadata: Mapping[str, str],
        *,
        clock: Clock = time.monotonic,
        notify: Callable[[str], None] = lambda _: None,
        capacity_bytes: int = BACKLOG_CAPACITY_BYTES,
        opener: FileOpener = open_new_file,
    ) -> None:
        if path.exists():
            raise RecordingError("{path} already exists; record to another name", path=path)
        self.path = path
        self._schema = make_samples_schema(units)
        # Loading Arrow takes a while. It must not delay motion or the first second of data.
        load_arrow()
        #: Host time at which the recording began, s.
        self.began_s = clock()
        self._clock = clock
        self._notify = notify
        self._backlog = RecordingBacklog(capacity_bytes)
        # Contents of segments that are not written yet.
        self._pending_segments: list[bytes] = []
        #: Why nothing can be written at present; None if writing works.
        self.failure: str | None = None
        # Message about lost data that the operator has not seen yet.
        self._loss_message = ""
        self._has_reported_slow_disk = False
        self._is_closed = False
        self._connection = 0
        self._device_clock = DeviceClock()
        self._last_device_time_s = self._last_host_time_s = float("-inf")
        self._write_lock = threading.Lock()
        self._tickers = (
            Ticker("recorder", SEGMENT_PERIOD_S, self._write_pending),
            Ticker("recorder sync", SEGMENT_PERIOD_S, self._sync),
        )
        header_metadata = {
            "id": uuid4().hex,
            "began_s": repr(self.began_s),
            "units": json.dumps(dict(units)),
            **metadata,
        }
        self._file = SegmentFile(path.with_name(path.name + UNFINISHED_SUFFIX), opener)
        try:
            self._file.append(encode_header(header_metadata))
        except OSError as error:
            self._file.close()
            self._file.path.unlink(missing_ok=True)
            raise RecordingError(
                "{path}: cannot be written ({reason}); make room, or choose another folder",
                path=path,
                reason=str(error.strerror or error),
            ) from error

    @property
    def bytes_written(self) -> int:
        """Size of the file, bytes."""
        return self._file.size

    def start(self) -> None:
        """Start the threads that write and sync."""
        for ticker in self._tickers:
            ticker.start()

    def start_connection(self) -> None:
        """Begin a new connection, because the device's time has restarted."""
        self._connection += 1
        self._device_clock = DeviceClock()
        self._last_device_time_s = float("-inf")

    def add(self, samples: DeviceSamples, model: FloatArray, received_s: float) -> None:
        """Add samples of a machine and the model outputs (n, axes), from one thread at a time.

        ``received_s`` is the host time at which the last sample was received.
        """
        if not len(samples) or self._is_closed:
            return
        # The device's time has restarted, although the caller did not announce a new connection.
        if samples.device_time_s[0] <= self._last_device_time_s:
            self.start_connection()
        self._last_device_time_s = float(samples.device_time_s[-1])
        fit = self._device_clock.observe(received_s, self._last_device_time_s)
        # A better estimate of the offset must not make the host time decrease.
        host_time_s = np.maximum(samples.device_time_s + fit.offset_s, self._last_host_time_s)
        self._last_host_time_s = float(host_time_s[-1])
        self._backlog.add(SampleBlock(self._connection, host_time_s, samples, model))
        values = {
            "connection": float(self._connection),
            "device_time_s": self._last_device_time_s,
            "offset_s": fit.offset_s,
            "uncertainty_s": fit.uncertainty_s,
        }
        self._backlog.add(ChannelRow(CLOCK_CHANNEL, received_s, values))

    def add_row(self, channel: str, host_time_s: float, values: Mapping[str, float]) -> None:
        """Add named values of a channel at a host time.

        New names add columns. A value that a row lacks is read back as NaN.
        """
        if not self._is_closed:
            self._backlog.add(ChannelRow(channel, host_time_s, dict(values)))

    def add_event(
        self,
        kind: str,
        text: str,
        details: Mapping[str, object] | None = None,
        host_time_s: float | None = None,
    ) -> None:
        """Add an event at a host time, by default now; ``details`` must be valid as JSON."""
        if not self._is_closed:
            event_s = self._clock() if host_time_s is None else host_time_s
            self._backlog.add(RecordedEvent(event_s, kind, text, json.dumps(details or {})))

    def run_once(self) -> None:
        """Write waiting data, and wait until they are on the disk; does nothing after a close."""
        self._write_pending()
        self._sync()

    def close(self) -> Path:
        """Write the remaining data, merge, and return the finished file; safe to call twice.

        Raises
        ------
        RecordingError
            If the file cannot be finished. The data stay in ``PATH.part`` and can be recovered.
        """
        if self._is_closed:
            return self.path
        for ticker in self._tickers:
            ticker.close(_MAX_CLOSE_S)
        # The first pass may add events, which the second one writes.
        for _ in range(2):
            self.run_once()
        self._is_closed = True
        self._file.close()
        if self.failure is not None:
            self._notify(
                message(
                    "engine", "{name}: the end of the recording could not be written ({failure})"
                ).fill(name=self.path.name, failure=self.failure)
            )
        return merge_segments(self._file.path, self.path)

    def _write_pending(self) -> None:
        """Write waiting data to the file, so that they survive a crash of this process."""
        with self._write_lock:
            if not self._is_closed and (not self._pending_segments or self._append_pending()):
                self._write_backlog()

    def _sync(self) -> None:
        """Wait until the written data are on the disk, so that they survive a power cut."""
        if self._is_closed:
            return
        began_s = self._clock()
        try:
            self._file.sync()
        except OSError as error:
            with self._write_lock:
                self._handle_failure(error.strerror or str(error))
        self._check_duration(self._clock() - began_s)

    def _write_backlog(self) -> None:
        entries = self._backlog.take_entries()
        loss = self._backlog.take_lost()
        if loss != BacklogLoss():
            self._loss_message = message(
                "engine", "{samples} samples and {others} other entries are missing"
            ).fill(samples=loss.samples, others=loss.others)
            details = json.dumps({"samples": loss.samples, "others": loss.others})
            entries.append(RecordedEvent(loss.since_s, "recorder", self._loss_message, details))
        self._pending_segments = encode_streams(entries, self._schema)
        if not self._pending_segments or self._append_pending():
            self._handle_success()

    def _append_pending(self) -> bool:
        began_s = self._clock()
        try:
            self._file.append(*self._pending_segments)
        except OSError as error:
            self._handle_failure(error.strerror or str(error))
            return False
        self._pending_segments = []
        self._check_duration(self._clock() - began_s)
        return True

    def _handle_failure(self, reason: str) -> None:
        if self.failure is None:
            self._record_and_notify(
                message(
                    "engine",
                    "{name}: the recording has failed ({reason}); the data so far are safe in "
                    "{path}. Free disk space; the motion continues",
                ).fill(name=self.path.name, reason=reason, path=self._file.path)
            )
        self.failure = reason

    def _handle_success(self) -> None:
        loss_message, self._loss_message = self._loss_message, ""
        if self.failure is not None or loss_message:
            self.failure = None
            summary = loss_message or marked("engine", "nothing is missing")
            self._record_and_notify(
                message("engine", "{file}: the recording continues; {what}").fill(
                    file=self.path.name, what=summary
                )
            )

    def _check_duration(self, duration_s: float) -> None:
        if duration_s > SLOW_WRITE_S and not self._has_reported_slow_disk:
            self._has_reported_slow_disk = True
            self._record_and_notify(
                message(
                    "engine",
                    "{name}: the disk took {took_s} s for a segment: a crash or a power cut now "
                    "could lose more than a second; record to a faster disk",
                ).fill(name=self.path.name, took_s=format_fixed(duration_s, 1))
            )

    def _record_and_notify(self, text: str) -> None:
        self.add_event("recorder", text)
        self._notify(text)
