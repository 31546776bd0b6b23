"""Paths are checked outside the window's thread, so that a stop never waits for the check."""

import threading

import numpy as np
import pytest

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap

PANELS = ("trajectory",)
TIMEOUT_MS = 30_000
TIME_S = np.arange(2001) / 500.0
TRAJECTORY = Record.from_signals(
    TIME_S, {("thx", Tap.CMD): 5.8e-4 + 2e-4 * np.sin(np.pi * TIME_S / 4.0) ** 2}, {"thx": "rad"}
)


class BlockingCheck:
    """A check of a trajectory that blocks until the test ends it."""

    def __init__(self):
        self.threads, self.started, self.may_end = [], threading.Event(), threading.Event()

    def __call__(self, *_):
        self.threads.append(threading.current_thread())
        self.started.set()
        assert self.may_end.wait(TIMEOUT_MS / 1e3)


@pytest.fixture
def blocking_check(window, monkeypatch):
    new_check = BlockingCheck()
    monkeypatch.setattr(window.workbench.session.bounds._guard, "check_trajectory", new_check)
    yield new_check
    new_check.may_end.set()


@pytest.fixture
def planned_workbench(qtbot, window):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=TIMEOUT_MS):
        window.workbench.plan_trajectory("path", TRAJECTORY)
    return window.workbench


def test_escape_stops_while_the_trajectory_is_checked(
    qtbot, window, planned_workbench, blocking_check, press_escape
):
    session, command = planned_workbench.session, planned_workbench.session.snapshot().command
    planned_workbench.play()  # would hang here
    assert blocking_check.started.wait(TIMEOUT_MS / 1e3)
    press_escape(window)
    assert session.snapshot().stop.by == "operator"
    blocking_check.may_end.set()
    qtbot.waitUntil(lambda: not planned_workbench._aside.busy, timeout=TIMEOUT_MS)
    assert blocking_check.threads[0] is not threading.main_thread()
    assert ["a stop came" in notice.text for notice in window.notices.notices()] == [True]
    assert planned_workbench.playback.state.phase is PlaybackPhase.IDLE
    assert session.snapshot().activity is DeviceState.IDLE
    assert dict(session.snapshot().command) == dict(command)


def toggle(qtbot, workbench):
    """Play, pause or resume as soon as this is possible."""
    qtbot.waitUntil(
        lambda: workbench.find_toggle_objection(workbench.playback.state) is None,
        timeout=TIMEOUT_MS,
    )
    workbench.toggle_playback()


def test_resumed_playback_is_checked_in_the_background(qtbot, planned_workbench, monkeypatch):
    planned_workbench.play()
    qtbot.waitUntil(
        lambda: planned_workbench.session.snapshot().activity is DeviceState.PLAYING,
        timeout=TIMEOUT_MS,
    )
    toggle(qtbot, planned_workbench)
    qtbot.waitUntil(
        lambda: planned_workbench.playback.state.phase is PlaybackPhase.PAUSED, timeout=TIMEOUT_MS
    )
    blocking_check = BlockingCheck()
    monkeypatch.setattr(planned_workbench.session.bounds._guard, "check_trajectory", blocking_check)
    toggle(qtbot, planned_workbench)
    assert blocking_check.started.wait(TIMEOUT_MS / 1e3)
    blocking_check.may_end.set()
    assert blocking_check.threads[0] is not threading.main_thread()
    planned_workbench.end_playback()
    qtbot.waitUntil(lambda: not planned_workbench._aside.busy, timeout=TIMEOUT_MS)


def test_refused_request_is_reported_and_undone(qtbot, window):
    workbench, calls = window.workbench, []

    def refuse():
        raise InputError("not today")

    workbench.ask_in_background(
        refuse, lambda: calls.append("done"), lambda: calls.append("undone")
    )
    workbench.ask_in_background(
        lambda: None, lambda: calls.append("done"), lambda: calls.append("undone")
    )
    qtbot.waitUntil(lambda: len(calls) == 2, timeout=TIMEOUT_MS)
    assert calls == ["undone", "done"]
    assert [notice.text for notice in window.notices.notices()] == ["not today"]
