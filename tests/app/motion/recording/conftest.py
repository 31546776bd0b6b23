"""Numbered samples, disks that fail on request, and a recorded session that a test steps."""

import errno
import io

import numpy as np
import pytest

from rotemina.app.motion.recording import SessionRecorder
from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.drivers.contract import DeviceSamples

UNITS = {"x": "m", "thx": "rad"}


def make_numbered_samples(first, count, rate_hz=1000.0, axes=2):
    """Return samples whose values contain the number of the sample."""
    number = np.arange(first, first + count)
    values = (number[:, None] * 16.0 + np.arange(axes)) / 3.0
    inputs = values * 1e-9
    inputs[:, 0] = np.nan
    rows = np.where(number % 7 == 0, number, -1)
    return DeviceSamples(number / rate_hz + 0.25, values, values * np.pi, inputs, rows)


def make_model(samples):
    return samples.command + 0.5


def check_samples(recorded, first, count):
    expected = make_numbered_samples(first, count)
    assert len(recorded) == count
    for name in ("device_time_s", "command", "measured", "inputs", "playback_row"):
        np.testing.assert_array_equal(getattr(recorded, name), getattr(expected, name))
    np.testing.assert_array_equal(recorded.model, make_model(expected))


@pytest.fixture
def check():
    return check_samples


class Disk:
    """A disk with room for ``room`` bytes that can fail or be slow."""

    def __init__(self, room=None):
        self.room = room
        self.failure = None
        self.before = lambda: None

    def open(self, path):
        return DiskFile(path, self)


class DiskFile(io.FileIO):
    def __init__(self, path, disk):
        super().__init__(path, "xb")
        self._disk = disk

    def write(self, data):
        disk = self._disk
        disk.before()
        if disk.failure is not None:
            raise OSError(disk.failure, "Input/output error")
        room = len(data) if disk.room is None else disk.room - self.tell()
        if room <= 0:
            raise OSError(errno.ENOSPC, "No space left on device")
        return super().write(bytes(data[:room]))


@pytest.fixture
def disk():
    return Disk()


@pytest.fixture
def notices():
    return []


@pytest.fixture
def make_writer(tmp_path, clock, disk, notices):
    writers = []

    def make(name="run.arrows", **options):
        writer = RecordingWriter(
            tmp_path / name,
            UNITS,
            {"robot": "two axes"},
            clock=clock,
            notify=notices.append,
            opener=disk.open,
            **options,
        )
        writers.append(writer)
        return writer

    yield make
    for writer in writers:
        writer._file.close()


@pytest.fixture
def feed(clock):
    """Return a function that adds samples in 20 ms portions, as a worker does."""

    def feed(writer, first, count, portion=20):
        for begin in range(first, first + count, portion):
            clock.advance(portion * 1e-3)
            samples = make_numbered_samples(begin, portion)
            writer.add(samples, make_model(samples), clock())
        return first + count

    return feed


class RecordedSession:
    """A stepped session with a recorder."""

    def __init__(self, harness, path, **options):
        self.harness = harness
        self.session = harness.session
        self.notices = []
        self.recorder = SessionRecorder(
            harness.session, path, clock=harness.clock, notify=self.notices.append, **options
        )
        self.recorder.start(thread=False)

    def step(self, seconds=0.02, times=1):
        for _ in range(times):
            state = self.harness.step(seconds)
            self.recorder.writer.run_once()
        return state

    def rest(self, seconds=0.2):
        return self.step(0.02, round(seconds / 0.02))


@pytest.fixture
def record(tmp_path):
    recorded_sessions = []

    def record(harness, name="session.arrows", **options):
        recorded_sessions.append(RecordedSession(harness, tmp_path / name, **options))
        return recorded_sessions[-1]

    yield record
    for recorded_session in recorded_sessions:
        recorded_session.recorder.writer._file.close()


@pytest.fixture
def make_samples():
    return make_numbered_samples
