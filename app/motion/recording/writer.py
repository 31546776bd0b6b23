"""The writer thread of a recording."""

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

from rotemina.app.files import Opener, new_file
from rotemina.app.motion.recording.arrow_tables import (
    CLOCK,
    header,
    prepare,
    samples_schema,
    streams,
)
from rotemina.app.motion.recording.backlog import Backlog, Block, Lost, RecordedEvent, Row
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recovery import UNFINISHED, merged
from rotemina.app.motion.recording.segments import SegmentFile
from rotemina.app.motion.ticker import Ticker
from rotemina.drivers.clock import Clock
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import fixed

SEGMENT_S = 0.25  # what a crash can lose, with the time that it takes to write so much
SLOW_S = 0.7  # a disk that takes longer for a segment endangers the promise of one second
CAPACITY_BYTES = 64_000_000  # of what waits: 14 s at 20 kHz and 24 channels, 5 min at 1 kHz
_PORTIONS = 512  # eight seconds of them: a clock that is 50 ppm off drifts by 0.4 ms meanwhile
_LONGEST_S = 60.0  # that a close waits for a disk that hangs


class ClockFit(NamedTuple):
    """``host_time_s`` = device time + ``offset_s``.

    ``uncertainty_s`` is how much later than the soonest samples typically come in. A delay that
    all of them share cannot be told from the offset: it is not in there.
    """

    offset_s: float
    uncertainty_s: float


class DeviceClock:
    """Follows the clock of a device through one connection.

    No sample comes in before it was taken, so the least of (host time of arrival) − (device time)
    over the last seconds is the best guess of the offset.
    """

    def __init__(self) -> None:
        self._delays_s: deque[float] = deque(maxlen=_PORTIONS)

    def observe(self, received_s: float, device_time_s: float) -> ClockFit:
        """Take in that the sample of a device time came in at a host time; return the fit."""
        self._delays_s.append(received_s - device_time_s)
        least_s = min(self._delays_s)
        return ClockFit(least_s, median(self._delays_s) - least_s)


class RecordingWriter:
    """Writes data to ``PATH.part``, one segment at a time, and merges it on close.

    ``add`` and ``record`` may be called from any thread and return at once. :meth:`run_once` writes
    waiting data; :meth:`start` uses two threads: one writes, one waits for the disk.

    If the disk is full, or fails, the operator is told once and the segment is retried each turn:
    new data wait in memory as far as there is room, then count as lost. When writing succeeds
    again, an event in the recording reports the loss.

    Parameters
    ----------
    path : Path
        Of the finished recording.
    units : mapping axis -> "m" or "rad"
        The axes, in the order of the samples' columns.
    metadata : mapping str -> str
        What holds for the whole recording.
    clock : callable
        The host's monotonic time, s.
    tell : callable
        Gets what the operator must know, on the thread that writes; motion is unaffected.
    capacity_bytes : int
        Of what may wait to be written.
    opener : callable
        How the file is made.

    Raises
    ------
    RecordingError
        If there is a file already, or none can be made.
    """

    def __init__(
        self,
        path: Path,
        units: Mapping[str, str],
        metadata: Mapping[str, str],
        *,
        clock: Clock = time.monotonic,
        tell: Callable[[str], None] = lambda _: None,
        capacity_bytes: int = CAPACITY_BYTES,
        opener: Opener = new_file,
    ) -> None:
        if path.exists():
            raise RecordingError(
                message("engine", "{path} already exists; record to another name").fill(path=path)
            )
        self.path = path
        self._schema = samples_schema(units)
        prepare()  # neither motion nor the first second is to wait for that
        #: Host time, s.
        self.began_s = clock()
        self._clock = clock
        self._tell = tell
        self._backlog = Backlog(capacity_bytes)
        self._waiting: list[bytes] = []  # a segment that the disk has not taken yet
        #: Why nothing can be written at present.
        self.failure: str | None = None
        self._gap = ""  # what is missing and was not told yet
        self._slow = False
        self._closed = False
        self._connection = 0
        self._device_clock = DeviceClock()
        self._device_time_s = self._host_time_s = float("-inf")
        self._writing = threading.Lock()
        self._tickers = (
            Ticker("recorder", SEGMENT_S, self._write),
            Ticker("recorder sync", SEGMENT_S, self._sync),
        )
        about = {
            "id": uuid4().hex,
            "began_s": repr(self.began_s),
            "units": json.dumps(dict(units)),
            **metadata,
        }
        self._file = SegmentFile(path.with_name(path.name + UNFINISHED), opener)
        try:
            self._file.append(header(about))
        except OSError as error:
            self._file.close()
            self._file.path.unlink(missing_ok=True)
            raise RecordingError(
                message(
                    "engine",
                    "{path}: cannot be written ({reason}); make room, or choose another folder",
                ).fill(path=path, reason=str(error.strerror or error))
            ) from error

    @property
    def bytes_written(self) -> int:
        """How much the disk holds."""
        return self._file.size

    def start(self) -> None:
        """Write on separate threads from now on."""
        for ticker in self._tickers:
            ticker.start()

    def connected(self) -> None:
        """Note that the device's time has restarted."""
        self._connection += 1
        self._device_clock = DeviceClock()
        self._device_time_s = float("-inf")

    def add(self, samples: Samples, model: FloatArray, received_s: float) -> None:
        """Take samples of a machine and the model's answers (n, axes); by one thread at a time.

        ``received_s`` is the host time at which the last of them came in.
        """
        if not len(samples) or self._closed:
            return
        if samples.device_time_s[0] <= self._device_time_s:  # nobody said that it begins anew
            self.connected()
        self._device_time_s = float(samples.device_time_s[-1])
        fit = self._device_clock.observe(received_s, self._device_time_s)
        # A better estimate must not make what is later earlier.
        host_time_s = np.maximum(samples.device_time_s + fit.offset_s, self._host_time_s)
        self._host_time_s = float(host_time_s[-1])
        self._backlog.add(Block(self._connection, host_time_s, samples, model))
        values = {
            "connection": float(self._connection),
            "device_time_s": self._device_time_s,
            "offset_s": fit.offset_s,
            "uncertainty_s": fit.uncertainty_s,
        }
        self._backlog.add(Row(CLOCK, received_s, values))

    def record(self, channel: str, host_time_s: float, values: Mapping[str, float]) -> None:
        """Take named numbers of a channel at a host time.

        Other names than before add columns; a value that a row lacks is read back as NaN.
        """
        if not self._closed:
            self._backlog.add(Row(channel, host_time_s, dict(values)))

    def event(
        self,
        kind: str,
        text: str,
        details: Mapping[str, object] | None = None,
        host_time_s: float | None = None,
    ) -> None:
        """Take an event, of now or of a host time; ``details`` must be what JSON can hold."""
        if not self._closed:
            at_s = self._clock() if host_time_s is None else host_time_s
            self._backlog.add(RecordedEvent(at_s, kind, text, json.dumps(details or {})))

    def run_once(self) -> None:
        """Write what waits, and wait until the disk has it; nothing happens after `close`."""
        self._write()
        self._sync()

    def close(self) -> Path:
        """Write the remaining data, merge, and return the finished file; safe to call twice.

        Raises
        ------
        RecordingError
            If that cannot be done; what was recorded stays in ``PATH.part`` to be recovered.
        """
        if self._closed:
            return self.path
        for ticker in self._tickers:
            ticker.close(_LONGEST_S)
        for _ in range(2):  # what the first writes may have something to tell
            self.run_once()
        self._closed = True
        self._file.close()
        if self.failure is not None:
            self._tell(
                message(
                    "engine", "{name}: the end of the recording could not be written ({failure})"
                ).fill(name=self.path.name, failure=self.failure)
            )
        return merged(self._file.path, self.path)

    def _write(self) -> None:
        """Have what waits outlive this process."""
        with self._writing:
            if not self._closed and (not self._waiting or self._append()):
                self._write_backlog()

    def _sync(self) -> None:
        """Make written data survive a power cut; the disk may take its time."""
        if self._closed:
            return
        began_s = self._clock()
        try:
            self._file.sync()
        except OSError as error:
            with self._writing:
                self._note_failure(error.strerror or str(error))
        self._note_speed(self._clock() - began_s)

    def _write_backlog(self) -> None:
        entries = self._backlog.take()
        lost = self._backlog.take_lost()
        if lost != Lost():
            self._gap = message(
                "engine", "{samples} samples and {others} other entries are missing"
            ).fill(samples=lost.samples, others=lost.others)
            details = json.dumps({"samples": lost.samples, "others": lost.others})
            entries.append(RecordedEvent(lost.since_s, "recorder", self._gap, details))
        self._waiting = streams(entries, self._schema)
        if not self._waiting or self._append():
            self._note_success()

    def _append(self) -> bool:
        """Write the segment that waits; return whether the disk has taken it."""
        began_s = self._clock()
        try:
            self._file.append(*self._waiting)
        except OSError as error:
            self._note_failure(error.strerror or str(error))
            return False
        self._waiting = []
        self._note_speed(self._clock() - began_s)
        return True

    def _note_failure(self, reason: str) -> None:
        if self.failure is None:
            self._notice(
                message(
                    "engine",
                    "{name}: the recording has failed ({reason}); the data so far are safe in "
                    "{path}. Free disk space; the motion continues",
                ).fill(name=self.path.name, reason=reason, path=self._file.path)
            )
        self.failure = reason

    def _note_success(self) -> None:
        gap, self._gap = self._gap, ""
        if self.failure is not None or gap:
            self.failure = None
            what = gap or marked("engine", "nothing is missing")
            self._notice(
                message("engine", "{file}: the recording continues; {what}").fill(
                    file=self.path.name, what=what
                )
            )

    def _note_speed(self, took_s: float) -> None:
        if took_s > SLOW_S and not self._slow:
            self._slow = True
            self._notice(
                message(
                    "engine",
                    "{name}: the disk took {took_s} s for a segment: a crash or a power cut now "
                    "could lose more than a second; record to a faster one",
                ).fill(name=self.path.name, took_s=fixed(took_s, 1))
            )

    def _notice(self, message: str) -> None:
        self.event("recorder", message)
        self._tell(message)
