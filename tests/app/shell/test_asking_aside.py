"""What checks a path is asked away from the window's thread, so that a stop never waits for it."""

import threading

import numpy as np
import pytest

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap

PANELS = ("trajectory",)
LONG_MS = 30_000
TIME_S = np.arange(2001) / 500.0
PATH = Record.from_signals(
    TIME_S, {("thx", Tap.CMD): 5.8e-4 + 2e-4 * np.sin(np.pi * TIME_S / 4.0) ** 2}, {"thx": "rad"}
)


class Check:
    """A check of a path that lasts until it is let go."""

    def __init__(self):
        self.threads, self.begun, self.may_end = [], threading.Event(), threading.Event()

    def __call__(self, *_):
        self.threads.append(threading.current_thread())
        self.begun.set()
        assert self.may_end.wait(LONG_MS / 1e3)


@pytest.fixture
def check(window, monkeypatch):
    made = Check()
    monkeypatch.setattr(window.workbench.session.bounds._guard, "play", made)
    yield made
    made.may_end.set()


@pytest.fixture
def planned(qtbot, window):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("path", PATH)
    return window.workbench


def test_esc_stops_while_the_path_to_be_played_is_checked(
    qtbot, window, planned, check, press_escape
):
    session, command = planned.session, planned.session.snapshot().command
    planned.play()  # would hang here
    assert check.begun.wait(LONG_MS / 1e3)
    press_escape(window)
    assert session.snapshot().stop.by == "operator"
    check.may_end.set()
    qtbot.waitUntil(lambda: not planned._aside.busy, timeout=LONG_MS)
    assert check.threads[0] is not threading.main_thread()
    assert ["a stop came" in notice.text for notice in window.notices.notices()] == [True]
    assert planned.playback.state.phase is PlaybackPhase.IDLE
    assert session.snapshot().activity is DeviceState.IDLE
    assert dict(session.snapshot().command) == dict(command)


def toggle(qtbot, bench):
    """Play, pause or resume, as soon as that counts."""
    qtbot.waitUntil(lambda: bench.against_toggling(bench.playback.state) is None, timeout=LONG_MS)
    bench.toggle_playback()


def test_a_playback_that_goes_on_is_checked_aside_too(qtbot, planned, monkeypatch):
    planned.play()
    qtbot.waitUntil(
        lambda: planned.session.snapshot().activity is DeviceState.PLAYING, timeout=LONG_MS
    )
    toggle(qtbot, planned)
    qtbot.waitUntil(lambda: planned.playback.state.phase is PlaybackPhase.PAUSED, timeout=LONG_MS)
    check = Check()
    monkeypatch.setattr(planned.session.bounds._guard, "play", check)
    toggle(qtbot, planned)
    assert check.begun.wait(LONG_MS / 1e3)
    check.may_end.set()
    assert check.threads[0] is not threading.main_thread()
    planned.end_playback()
    qtbot.waitUntil(lambda: not planned._aside.busy, timeout=LONG_MS)


def test_what_is_refused_is_told_and_undone(qtbot, window):
    bench, called = window.workbench, []

    def refuse():
        raise InputError("not today")

    bench.ask_aside(refuse, lambda: called.append("done"), lambda: called.append("undone"))
    bench.ask_aside(lambda: None, lambda: called.append("done"), lambda: called.append("undone"))
    qtbot.waitUntil(lambda: len(called) == 2, timeout=LONG_MS)
    assert called == ["undone", "done"]
    assert [notice.text for notice in window.notices.notices()] == ["not today"]
