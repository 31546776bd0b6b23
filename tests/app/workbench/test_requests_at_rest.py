"""No waiting request is lost silently: it is carried out, or its withdrawal is reported."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.workbench import OperatorRequests, WaitingRequest
from rotemina.app.workbench.requests_at_rest import AtRestScheduler
from rotemina.drivers.contract import DeviceState
from rotemina.sim.records import Record, Tap, write_record

PANELS = ("trajectory",)
LONG_MS = 30_000
WITHDRAWAL_TEXT = "Not played: {why}. Press Play again."
TIME_S = np.arange(1001) / 500.0


def make_swing(height=2e-4):
    command = 5.8e-4 + height * np.sin(np.pi * TIME_S / 2.0) ** 2
    return Record.from_signals(TIME_S, {("thx", Tap.CMD): command}, {"thx": "rad"})


class RequestRecorder(OperatorRequests):
    """Requests to a machine that never comes to rest."""

    def __init__(self, session):
        super().__init__(session)
        self.requests, self.messages = [], []
        self.withdrawn.connect(self.messages.append)

    def ask_in_background(self, request, done=None, undone=None):
        self.requests.append(request)


@pytest.fixture
def moving_machine(qapp, harness, monkeypatch):
    session = harness.session
    monkeypatch.setattr(type(session), "at_rest", False)
    state = replace(session.snapshot(), activity=DeviceState.MOVING, lock_reason=None)
    monkeypatch.setattr(session, "snapshot", lambda: state)
    return RequestRecorder(session)


def get_notice_texts(window):
    return [notice.text for notice in window.notices.notices()]


def plan_swing(qtbot, window):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("swing", make_swing())
    return window.panels["trajectory"]


def test_a_request_waits_at_most_two_seconds_for_rest_and_counts_once(moving_machine):
    now = [0.0]
    scheduler = AtRestScheduler(moving_machine, lambda: now[0])
    for press in ("first press", "second press"):
        scheduler.do(WaitingRequest(moving_machine, WITHDRAWAL_TEXT), press)
    now[0] = 1.9
    scheduler.make_if_resting(moving_machine.session.snapshot())
    assert scheduler.waiting
    assert moving_machine.requests == []
    now[0] = 2.0
    scheduler.make_if_resting(moving_machine.session.snapshot())
    assert not scheduler.waiting
    assert moving_machine.requests == ["second press"]  # the session refuses it with the reason
    assert moving_machine.messages == []


def test_a_replaced_request_is_reported(moving_machine):
    scheduler, withdrawn = AtRestScheduler(moving_machine), []
    for name, text in (("play", WITHDRAWAL_TEXT), ("run", "Not run: {why}.")):
        request = WaitingRequest(
            moving_machine, text, on_refused=lambda name=name: withdrawn.append(name)
        )
        scheduler.do(request, name)
    assert withdrawn == ["play"]
    assert moving_machine.messages == [
        "Not played: another request took its place. Press Play again."
    ]


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda session: session.stop(), "a stop came meanwhile"),
        (lambda session: session.emergency_stop(), "a stop came meanwhile"),
        (lambda session: session.release(), "the lock was released meanwhile"),
        (
            lambda session: session._link.gate.start_connection(),
            "the connection has changed meanwhile",
        ),
    ],
)
def test_an_overtaken_request_is_withdrawn_once_and_reported(moving_machine, change, why):
    scheduler, withdrawn = AtRestScheduler(moving_machine), []
    request = WaitingRequest(
        moving_machine, WITHDRAWAL_TEXT, on_refused=lambda: withdrawn.append(True)
    )
    scheduler.do(request, "request")
    change(moving_machine.session)
    for _ in range(2):
        scheduler.make_if_resting(moving_machine.session.snapshot())
        assert not request.is_waiting
    assert not scheduler.waiting
    assert moving_machine.requests == []
    assert withdrawn == [True]
    assert moving_machine.messages == [f"Not played: {why}. Press Play again."]


def test_play_shows_its_waiting_and_its_withdrawal_by_a_stop(qtbot, window, monkeypatch):
    panel, bench = plan_swing(qtbot, window), window.workbench
    transport = panel.transport
    qtbot.waitUntil(transport.play.isEnabled, timeout=LONG_MS)
    monkeypatch.setattr(type(bench.session), "at_rest", False)
    qtbot.mouseClick(transport.play, Qt.MouseButton.LeftButton)
    panel.update_now()
    assert not transport.play.isEnabled()
    assert "waits until the machine is at rest" in transport.play.toolTip()
    assert transport.progress.format() == "Waits until the machine is at rest …"
    bench.stop()
    qtbot.waitUntil(lambda: bool(get_notice_texts(window)), timeout=LONG_MS)
    assert get_notice_texts(window) == ["Not played: a stop came meanwhile. Press Play again."]
    bench.emergency_stop()
    bench.play()
    qtbot.waitUntil(lambda: len(get_notice_texts(window)) == 2, timeout=LONG_MS)
    assert "lock" in get_notice_texts(window)[0]


def test_a_motion_is_not_played_if_its_dry_run_is_overtaken(qtbot, window):
    panel, bench, played = plan_swing(qtbot, window), window.workbench, []
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("other", make_swing(1e-4))
        panel.update_now()
        assert "the dry run of other is under way" in panel.transport.play.toolTip()
        assert panel.transport.progress.format() == "Dry run of other …"
        bench.play()
    assert bench.playback.state.phase is PlaybackPhase.IDLE
    request = WaitingRequest(bench, WITHDRAWAL_TEXT)
    bench.plan_and_play("first", make_swing(), request, played.append)
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("second", make_swing())
    assert not request.is_waiting
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        request = WaitingRequest(bench, WITHDRAWAL_TEXT)
        bench.plan_and_play("third", make_swing(), request, played.append)
        bench.stop()
    assert played == []
    assert set(get_notice_texts(window)) == {
        "Not played: the dry run of other has not ended yet. Press Play again.",
        "Not played: another trajectory was loaded meanwhile. Press Play again.",
        "Not played: a stop came meanwhile. Press Play again.",
    }


def test_files_are_reported_when_written_at_once_or_replaced_while_being_read(
    qtbot, window, tmp_path
):
    paths = [tmp_path / "first.csv", tmp_path / "second.csv"]
    for path in paths:
        window.workbench.write_file("save", path, partial(write_record, make_swing(), path))
    qtbot.waitUntil(lambda: len(get_notice_texts(window)) == 2, timeout=LONG_MS)
    assert set(get_notice_texts(window)) == {f"Saved {path}" for path in paths}
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        for path in paths:
            window.workbench.planner.load_trajectory(path)
    assert "Replaced by a newer request: Reading first.csv …" in get_notice_texts(window)
