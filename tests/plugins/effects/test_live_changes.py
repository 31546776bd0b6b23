"""Sending effects to a session that is slow, drops requests or refuses them."""

from dataclasses import dataclass, field, replace

import pytest
from PySide6.QtCore import QObject

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.state import (
    CommandRefused,
    ConnectionState,
    SessionState,
)
from rotemina.plugins.effects import live_changes as module
from rotemina.plugins.effects.live_changes import ApplyState, LiveEffects
from rotemina.sim.robot import AxisEffect

FIRST = (AxisEffect(axis="thx", id="hysteresis"),)
SECOND = (AxisEffect(axis="thy", id="hysteresis"),)
THIRD = (AxisEffect(axis="zn", id="hysteresis"),)


@dataclass
class FakeSession:
    """A session whose effects change only when the test sets them."""

    effects: tuple = ()
    requests: list = field(default_factory=list)
    refusal: str = ""
    callback: object = None

    @property
    def service(self):
        return self

    def set_effects(self, effects):
        if self.refusal:
            raise RequestRefusedError(self.refusal)
        self.requests.append(effects)

    def subscribe(self, listener):
        self.callback = listener
        return lambda: None


@pytest.fixture
def session():
    return FakeSession()


@pytest.fixture
def live(qtbot, session, monkeypatch):
    monkeypatch.setattr(module, "MIN_CHANGE_INTERVAL_MS", 0)
    owner = QObject()
    yield LiveEffects(session, owner)
    owner.deleteLater()


def make_state(time_s, queued=0, connection=ConnectionState.CONNECTED):
    return SessionState(connection=connection, device_time_s=time_s, queued=queued)


def refresh_at(live, *times, **options):
    for time_s in times:
        live.refresh(make_state(time_s, **options))


def send(qtbot, live, session, effects):
    count = len(session.requests)
    live.request(effects)
    qtbot.waitUntil(lambda: len(session.requests) > count)


def test_only_the_last_of_several_quick_changes_is_sent_and_applied(qtbot, live, session):
    live.request(FIRST)
    send(qtbot, live, session, SECOND)
    assert session.requests == [SECOND]
    assert live.apply_state is ApplyState.UNDER_WAY
    session.service.effects = SECOND
    refresh_at(live, 1.0)
    assert live.apply_state is ApplyState.APPLIED


def test_while_one_change_is_under_way_only_the_newest_waits(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    for effects in (SECOND, THIRD):
        live.request(effects)
        qtbot.waitUntil(lambda: not live._pause.isActive())
    assert session.requests == [FIRST]
    session.service.effects = FIRST
    refresh_at(live, 1.0)
    assert session.requests == [FIRST, THIRD]
    assert live.apply_state is ApplyState.UNDER_WAY


def test_a_slow_change_is_shown_as_preparing(qtbot, live, session, monkeypatch):
    monkeypatch.setattr(module, "PREPARING_AFTER_MS", 0)
    send(qtbot, live, session, FIRST)
    refresh_at(live, 1.0, 1.0, 1.0, 1.0)  # the worker is busy: no new samples
    assert live.apply_state is ApplyState.PREPARING
    session.service.effects = FIRST
    refresh_at(live, 2.0)
    assert live.apply_state is ApplyState.APPLIED


def test_a_dropped_request_is_sent_once_more(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    refresh_at(live, 1.0, 2.0, 3.0, queued=1)
    assert session.requests == [FIRST]
    refresh_at(live, 3.0, 4.0, 5.0)
    assert session.requests == [FIRST, FIRST]
    refresh_at(live, 6.0, 7.0, 8.0)
    assert session.requests == [FIRST, FIRST]
    assert (live.apply_state, live.reason) == (
        ApplyState.REFUSED,
        "the simulator did not accept the change",
    )


def test_a_refusal_by_the_worker_or_a_lost_device_ends_the_wait(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    session.callback(CommandRefused("unstable"))
    refresh_at(live, 1.0, 2.0, 3.0)
    assert (live.apply_state, live.reason) == (ApplyState.REFUSED, "unstable")
    assert session.requests == [FIRST]  # it is not repeated
    send(qtbot, live, session, SECOND)
    session.callback(CommandRefused("width = 1"))
    live.refresh(replace(make_state(4.0), fault="it diverged"))
    assert live.apply_state is ApplyState.REFUSED
    send(qtbot, live, session, THIRD)
    refresh_at(live, 5.0, connection=ConnectionState.FAILED)
    assert live.apply_state is ApplyState.REFUSED
    assert session.requests == [FIRST, SECOND, THIRD]


def test_an_immediate_refusal_is_reported(qtbot, live, session):
    session.refusal = "the queue is full"
    with qtbot.waitSignal(live.refused) as refusal:
        live.request(FIRST)
    assert refusal.args == ["the queue is full"]
    assert live.apply_state is ApplyState.REFUSED


def test_only_effects_set_by_others_are_reported_and_once(qtbot, live, session):
    replacements = []
    live.replaced.connect(replacements.append)
    session.service.effects = SECOND
    refresh_at(live, 1.0, 2.0)
    assert replacements == [SECOND]
    send(qtbot, live, session, FIRST)
    session.service.effects = FIRST
    refresh_at(live, 3.0, 4.0)
    assert replacements == [SECOND]
