"""Samples made by number, disks that fail on request, and a recorded session stepped by hand."""

import errno
import io

import numpy as np
import pytest

from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.drivers.samples import Samples

UNITS = {"x": "m", "thx": "rad"}


def made_samples(first, count, rate_hz=1000.0, axes=2):
    """Samples whose every value tells which one it is."""
    number = np.arange(first, first + count)
    values = (number[:, None] * 16.0 + np.arange(axes)) / 3.0
    inputs = values * 1e-9
    inputs[:, 0] = np.nan
    rows = np.where(number % 7 == 0, number, -1)
    return Samples(number / rate_hz + 0.25, values, values * np.pi, inputs, rows)


def made_model(samples):
    return samples.command + 0.5


def check_samples(recorded, first, count):
    expected = made_samples(first, count)
    assert len(recorded) == count
    for name in ("device_time_s", "command", "measured", "inputs", "playback_row"):
        np.testing.assert_array_equal(getattr(recorded, name), getattr(expected, name))
    np.testing.assert_array_equal(recorded.model, made_model(expected))


@pytest.fixture
def check():
    return check_samples


class Disk:
    """Makes files of a disk that has ``room`` bytes, and may fail or be slow."""

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
    made = []

    def make(name="run.arrows", **options):
        writer = RecordingWriter(
            tmp_path / name,
            UNITS,
            {"robot": "two axes"},
            clock=clock,
            tell=notices.append,
            opener=disk.open,
            **options,
        )
        made.append(writer)
        return writer

    yield make
    for writer in made:
        writer._file.close()


@pytest.fixture
def feed(clock):
    """Hand samples over as a worker does, 20 ms of them at a time."""

    def feed(writer, first, count, portion=20):
        for begin in range(first, first + count, portion):
            clock.advance(portion * 1e-3)
            samples = made_samples(begin, portion)
            writer.add(samples, made_model(samples), clock())
        return first + count

    return feed


class Recorded:
    """A stepped session with a recorder on it."""

    def __init__(self, stepped, path, **options):
        self.stepped = stepped
        self.session = stepped.session
        self.notices = []
        self.recorder = SessionRecorder(
            stepped.session, path, clock=stepped.clock, tell=self.notices.append, **options
        )
        self.recorder.start(thread=False)

    def step(self, seconds=0.02, times=1):
        for _ in range(times):
            state = self.stepped.step(seconds)
            self.recorder.writer.run_once()
        return state

    def rest(self, seconds=0.2):
        return self.step(0.02, round(seconds / 0.02))


@pytest.fixture
def record(tmp_path):
    made = []

    def record(stepped, name="session.arrows", **options):
        made.append(Recorded(stepped, tmp_path / name, **options))
        return made[-1]

    yield record
    for one in made:
        one.recorder.writer._file.close()


@pytest.fixture
def numbered():
    return made_samples
