"""When the record of a playback is stored, compared and reported."""

from types import SimpleNamespace

import numpy as np
import pytest

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.workbench import played_records
from rotemina.app.workbench.played_records import PlaybackRecords
from rotemina.sim.records import Record, Tap

RECORD = Record.from_signals(np.array([0.0, 0.5]), {("x", Tap.CMD): np.zeros(2)}, {"x": "m"})


class PlaybackBench:
    """A stub of session, library and playback for the playback records."""

    def __init__(self, tmp_path):
        self.phase = PlaybackPhase.IDLE
        self.model = None
        self.calls, self.messages, self.compared = [], [], []
        self.folder = tmp_path
        self.records = PlaybackRecords(self, self, lambda: self.phase, self.work)
        self.records.stored.connect(lambda _: self.calls.append("stored"))
        self.records.stopped_early.connect(self.messages.append)
        self.records.compared.connect(lambda run, path: self.compared.append((run, path)))

    def subscribe(self, subscriber):
        self.emit = subscriber
        return lambda: self.calls.append("closed")

    def make_path(self, name):
        return self.folder / f"{name}.csv"

    def add(self, path, record, name):
        self.calls.append("listed")

    def set_gap(self, path, run):
        self.calls.append("gap")

    def work(self, kind, doing, work, done, **_):
        done(work())

    def end(self, record=RECORD, *, completed=True):
        event = PlaybackFinished(record, completed)
        self.emit(event)
        assert self.records.has_pending_end
        self.records.take_playback(event, "tour")
        assert not self.records.has_pending_end


@pytest.fixture
def bench(tmp_path, monkeypatch):
    run = SimpleNamespace()
    monkeypatch.setattr(played_records, "compare_with_model", lambda *_, **__: run)
    return PlaybackBench(tmp_path)


def test_a_playback_is_stored_before_it_is_compared(bench):
    bench.end()
    assert bench.calls == ["stored", "listed", "gap"]
    assert [path.name for _, path in bench.compared] == ["tour.csv"]
    assert (bench.folder / "tour.csv").exists()
    assert bench.messages == []


def test_a_move_to_a_start_point_is_not_a_run(bench):
    bench.emit(PlaybackFinished(RECORD, True, shown=False))
    assert not bench.records.has_pending_end


def test_a_paused_run_is_reported_when_the_playback_ends(bench):
    bench.phase = PlaybackPhase.PAUSED
    bench.end(completed=False)
    bench.records.report_paused_run()
    assert (bench.compared, bench.messages) == ([], [])
    bench.phase = PlaybackPhase.IDLE
    bench.records.report_paused_run()
    bench.records.report_paused_run()
    assert len(bench.compared) == 1


def test_a_resumed_pause_is_never_reported(bench):
    bench.phase = PlaybackPhase.PAUSED
    bench.end(completed=False)
    bench.phase = PlaybackPhase.PLAYING
    bench.end()
    bench.phase = PlaybackPhase.IDLE
    bench.records.report_paused_run()
    assert len(bench.compared) == 1


@pytest.mark.parametrize(
    ("record", "expected"), [(RECORD, "stopped after 0.50 s"), (None, "before its first row")]
)
def test_a_stopped_playback_is_reported(bench, record, expected):
    bench.end(record, completed=False)
    (text,) = bench.messages
    assert expected in text
