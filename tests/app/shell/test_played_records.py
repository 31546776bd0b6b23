"""What is stored and compared of a playback, and when it is taken in hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.shell import played_records
from rotemina.app.shell.played_records import PlayedRecords
from rotemina.sim.records.record import Record, Tap

RECORD = Record.from_signals(np.array([0.0, 0.5]), {("x", Tap.CMD): np.zeros(2)}, {"x": "m"})


class Bench:
    """A session, a library and a playback, as far as the records of playbacks need them."""

    def __init__(self, tmp_path):
        self.phase = PlaybackPhase.IDLE
        self.model = None
        self.done, self.told, self.handed_over = [], [], []
        self.folder = tmp_path
        self.records = PlayedRecords(self, self, lambda: self.phase, self.work)
        self.records.stored.connect(lambda _: self.done.append("stored"))
        self.records.told.connect(self.told.append)
        self.records.compared.connect(lambda run, path: self.handed_over.append((run, path)))

    def subscribe(self, subscriber):
        self.emit = subscriber
        return lambda: self.done.append("closed")

    def place(self, name):
        return self.folder / f"{name}.csv"

    def add(self, path, record, name):
        self.done.append("listed")

    def set_gap(self, path, run):
        self.done.append("gap")

    def work(self, kind, doing, work, done, **_):
        done(work())

    def end(self, record=RECORD, *, completed=True):
        event = PlaybackFinished(record, completed)
        self.emit(event)
        assert self.records.untold
        self.records.take(event, "tour")
        assert not self.records.untold


@pytest.fixture
def bench(tmp_path, monkeypatch):
    run = SimpleNamespace()
    monkeypatch.setattr(played_records, "compared", lambda *_, **__: run)
    return Bench(tmp_path)


def test_a_playback_is_stored_before_it_is_compared(bench):
    bench.end()
    assert bench.done == ["stored", "listed", "gap"]
    assert [path.name for _, path in bench.handed_over] == ["tour.csv"]
    assert (bench.folder / "tour.csv").exists()
    assert bench.told == []


def test_a_way_to_somewhere_is_no_run(bench):
    bench.emit(PlaybackFinished(RECORD, True, shown=False))
    assert not bench.records.untold


def test_a_pause_is_stored_and_taken_in_hand_when_the_playback_ends_there(bench):
    bench.phase = PlaybackPhase.PAUSED
    bench.end(completed=False)
    bench.records.look()
    assert (bench.handed_over, bench.told) == ([], [])
    bench.phase = PlaybackPhase.IDLE
    bench.records.look()
    bench.records.look()
    assert len(bench.handed_over) == 1


def test_a_pause_whose_playback_goes_on_is_never_taken_in_hand(bench):
    bench.phase = PlaybackPhase.PAUSED
    bench.end(completed=False)
    bench.phase = PlaybackPhase.PLAYING
    bench.end()
    bench.phase = PlaybackPhase.IDLE
    bench.records.look()
    assert len(bench.handed_over) == 1


@pytest.mark.parametrize(
    ("record", "told"), [(RECORD, "stopped after 0.50 s"), (None, "before its first row")]
)
def test_a_playback_that_was_stopped_is_told(bench, record, told):
    bench.end(record, completed=False)
    (text,) = bench.told
    assert told in text
