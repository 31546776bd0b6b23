"""No request that waits is lost without a word: each is taken, or its end is reported."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.shell.operator_requests import Requests
from rotemina.app.shell.requests_at_rest import AtRest, WaitingRequest
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record

PANELS = ("trajectory",)
LONG_MS = 30_000
WITHDRAWN = "Not played: {why}. Press Play again."
TIME_S = np.arange(1001) / 500.0


def swing(height=2e-4):
    command = 5.8e-4 + height * np.sin(np.pi * TIME_S / 2.0) ** 2
    return Record.from_signals(TIME_S, {("thx", Tap.CMD): command}, {"thx": "rad"})


class Moving(Requests):
    """A machine that never comes to rest, and what is asked of it."""

    def __init__(self, session):
        super().__init__(session)
        self.asked, self.told = [], []
        self.withdrawn.connect(self.told.append)

    def ask_aside(self, request, done=None, undone=None):
        self.asked.append(request)


@pytest.fixture
def moving(window, monkeypatch):
    session = window.workbench.session
    monkeypatch.setattr(type(session), "at_rest", False)
    state = replace(session.snapshot(), activity=DeviceState.MOVING, locked=None)
    monkeypatch.setattr(session, "snapshot", lambda: state)
    return Moving(session)


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def plan(qtbot, window):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("swing", swing())
    return window.panels["trajectory"]


def test_what_waits_for_rest_is_made_after_two_seconds(moving):
    now = [0.0]
    waits = AtRest(moving, lambda: now[0])
    waits.do(WaitingRequest(moving, WITHDRAWN), "asked")
    now[0] = 1.9
    waits.look(moving.session.snapshot())
    assert waits.waiting
    assert moving.asked == []
    now[0] = 2.0
    waits.look(moving.session.snapshot())
    assert not waits.waiting
    assert moving.asked == ["asked"]  # which is refused, with the reason
    assert moving.told == []


def test_a_request_that_another_one_replaces_is_reported(moving):
    waits, undone = AtRest(moving), []
    waits.do(WaitingRequest(moving, WITHDRAWN, undone=lambda: undone.append("play")), "play")
    other = WaitingRequest(moving, "Not run: {why}.", undone=lambda: undone.append("run"))
    waits.do(other, "run")
    assert undone == ["play"]
    assert moving.told == ["Not played: another request took its place. Press Play again."]


def test_the_same_request_pressed_twice_is_one(moving):
    waits, now = AtRest(moving, lambda: now[0]), [0.0]
    waits.do(WaitingRequest(moving, WITHDRAWN), "first press")
    waits.do(WaitingRequest(moving, WITHDRAWN), "second press")
    now[0] = 2.0
    waits.look(moving.session.snapshot())
    assert moving.asked == ["second press"]
    assert moving.told == []


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda session: session.stop(), "a stop came meanwhile"),
        (lambda session: session.emergency_stop(), "a stop came meanwhile"),
        (lambda session: session.release(), "the lock was released meanwhile"),
        (lambda session: session._link.gate.reconnected(), "the connection has changed meanwhile"),
    ],
)
def test_a_request_that_something_overtakes_is_withdrawn_once_and_reported(moving, change, why):
    waits, undone = AtRest(moving), []
    request = WaitingRequest(moving, WITHDRAWN, undone=lambda: undone.append(True))
    waits.do(request, "asked")
    change(moving.session)
    for _ in range(2):
        waits.look(moving.session.snapshot())
        assert not request.waits
    assert not waits.waiting
    assert moving.asked == []
    assert undone == [True]
    assert moving.told == [f"Not played: {why}. Press Play again."]


def test_play_on_a_locked_machine_says_why_nothing_plays(qtbot, window):
    plan(qtbot, window)
    window.workbench.emergency_stop()
    window.workbench.play()
    qtbot.waitUntil(lambda: bool(notices(window)), timeout=LONG_MS)
    assert "lock" in notices(window)[0]


def test_play_says_what_it_waits_for_and_that_a_stop_withdrew_it(qtbot, window, monkeypatch):
    panel, bench = plan(qtbot, window), window.workbench
    transport = panel.transport
    qtbot.waitUntil(transport.play.isEnabled, timeout=LONG_MS)
    monkeypatch.setattr(type(bench.session), "at_rest", False)
    qtbot.mouseClick(transport.play, Qt.MouseButton.LeftButton)
    panel.look_now()
    assert not transport.play.isEnabled()
    assert "waits until the machine is at rest" in transport.play.toolTip()
    assert transport.progress.format() == "Waits until the machine is at rest …"
    bench.stop()
    qtbot.waitUntil(lambda: bool(notices(window)), timeout=LONG_MS)
    assert notices(window) == ["Not played: a stop came meanwhile. Press Play again."]


def test_play_during_a_dry_run_is_refused_and_not_played_by_the_plan_before(qtbot, window):
    panel, bench = plan(qtbot, window), window.workbench
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("other", swing(1e-4))
        panel.look_now()
        assert "the dry run of other is under way" in panel.transport.play.toolTip()
        assert panel.transport.progress.format() == "Dry run of other …"
        bench.play()
    assert notices(window) == [
        "Not played: the dry run of other has not ended yet. Press Play again."
    ]
    assert bench.playback.state.phase is PlaybackPhase.IDLE


def test_a_motion_waiting_for_its_dry_run_is_withdrawn_when_another_is_loaded(qtbot, window):
    bench, played = window.workbench, []
    request = WaitingRequest(bench, WITHDRAWN)
    bench.plan_and_play("first", swing(), request, played.append)
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("second", swing())
    assert not request.waits
    assert played == []
    assert notices(window) == [
        "Not played: another trajectory was loaded meanwhile. Press Play again."
    ]


def test_a_motion_waiting_for_its_dry_run_is_not_played_after_a_stop(qtbot, window):
    bench, played = window.workbench, []
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_and_play("first", swing(), WaitingRequest(bench, WITHDRAWN), played.append)
        bench.stop()
    assert played == []
    assert notices(window) == ["Not played: a stop came meanwhile. Press Play again."]


def test_a_file_whose_reading_another_replaces_is_reported(qtbot, window, tmp_path):
    paths = [tmp_path / "first.csv", tmp_path / "second.csv"]
    for path in paths:
        write_record(swing(), path)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        for path in paths:
            window.workbench.load_trajectory(path)
    assert notices(window) == ["Replaced by a newer request: Reading first.csv …"]


def test_each_of_two_files_that_are_written_at_once_is_reported(qtbot, window, tmp_path):
    paths = [tmp_path / "first.csv", tmp_path / "second.csv"]
    for path in paths:
        window.workbench.write_file("save", path, path.touch)
    qtbot.waitUntil(lambda: len(notices(window)) == 2, timeout=LONG_MS)
    assert set(notices(window)) == {f"Saved {path}" for path in paths}
