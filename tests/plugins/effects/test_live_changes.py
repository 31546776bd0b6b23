"""Effects on their way to a session that takes its time, forgets, or refuses."""

from dataclasses import dataclass, field, replace

import pytest
from PySide6.QtCore import QObject

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.state import CommandRefused, Connection, SessionState
from rotemina.plugins.effects import live_changes as module
from rotemina.plugins.effects.live_changes import ApplyState, LiveEffects
from rotemina.sim.robot.model import AxisEffect

FIRST = (AxisEffect(axis="thx", id="hysteresis"),)
SECOND = (AxisEffect(axis="thy", id="hysteresis"),)
THIRD = (AxisEffect(axis="zn", id="hysteresis"),)


@dataclass
class Session:
    """Takes effects when the test lets it."""

    effects: tuple = ()
    asked: list = field(default_factory=list)
    refusal: str = ""
    tell: object = None

    @property
    def service(self):
        return self

    def set_effects(self, effects):
        if self.refusal:
            raise RefusedError(self.refusal)
        self.asked.append(effects)

    def subscribe(self, callback):
        self.tell = callback
        return lambda: None


@pytest.fixture
def session():
    return Session()


@pytest.fixture
def live(qtbot, session, monkeypatch):
    monkeypatch.setattr(module, "PAUSE_MS", 0)
    owner = QObject()
    yield LiveEffects(session, owner)
    owner.deleteLater()


def state(time_s, queued=0, connection=Connection.CONNECTED):
    return SessionState(connection=connection, device_time_s=time_s, queued=queued)


def cycles(live, *times, **options):
    for time_s in times:
        live.refresh(state(time_s, **options))


def send(qtbot, live, session, effects):
    count = len(session.asked)
    live.ask(effects)
    qtbot.waitUntil(lambda: len(session.asked) > count)


def test_what_was_taken_is_applied(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    assert live.apply_state is ApplyState.UNDER_WAY
    session.service.effects = FIRST
    cycles(live, 1.0)
    assert live.apply_state is ApplyState.APPLIED


def test_while_one_change_is_under_way_only_the_newest_waits(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    for effects in (SECOND, THIRD):
        live.ask(effects)
        qtbot.waitUntil(lambda: not live._pause.isActive())
    assert session.asked == [FIRST]
    session.service.effects = FIRST
    cycles(live, 1.0)
    assert session.asked == [FIRST, THIRD]
    assert live.apply_state is ApplyState.UNDER_WAY


def test_of_several_in_a_row_the_last_is_sent(qtbot, live, session):
    live.ask(FIRST)
    send(qtbot, live, session, SECOND)
    assert session.asked == [SECOND]


def test_what_takes_long_is_being_prepared(qtbot, live, session, monkeypatch):
    monkeypatch.setattr(module, "LONG_MS", 0)
    send(qtbot, live, session, FIRST)
    cycles(live, 1.0, 1.0, 1.0, 1.0)  # the worker is busy: no new samples
    assert live.apply_state is ApplyState.PREPARING
    session.service.effects = FIRST
    cycles(live, 2.0)
    assert live.apply_state is ApplyState.APPLIED


def test_what_a_stop_swept_away_is_sent_once_more(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    cycles(live, 1.0, 2.0, 3.0, queued=1)
    assert session.asked == [FIRST]
    cycles(live, 3.0, 4.0, 5.0)
    assert session.asked == [FIRST, FIRST]
    cycles(live, 6.0, 7.0, 8.0)
    assert session.asked == [FIRST, FIRST]
    assert (live.apply_state, live.reason) == (
        ApplyState.REFUSED,
        "the simulator did not accept the change",
    )


def test_what_the_worker_refuses_is_not_sent_again(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    session.tell(CommandRefused("unstable"))
    cycles(live, 1.0, 2.0, 3.0)
    assert (live.apply_state, live.reason) == (ApplyState.REFUSED, "unstable")
    assert session.asked == [FIRST]


def test_a_refusal_in_a_fault_ends_the_waiting_though_device_time_stands_still(
    qtbot, live, session
):
    send(qtbot, live, session, FIRST)
    session.tell(CommandRefused("width = 1"))
    live.refresh(replace(state(1.0), fault="it diverged"))
    assert live.apply_state is ApplyState.REFUSED
    send(qtbot, live, session, SECOND)
    assert session.asked == [FIRST, SECOND]


def test_what_the_session_refuses_at_once_is_told(qtbot, live, session):
    session.refusal = "the queue is full"
    with qtbot.waitSignal(live.refused) as told:
        live.ask(FIRST)
    assert told.args == ["the queue is full"]
    assert live.apply_state is ApplyState.REFUSED


def test_a_lost_device_ends_the_waiting(qtbot, live, session):
    send(qtbot, live, session, FIRST)
    cycles(live, 1.0, connection=Connection.FAILED)
    assert live.apply_state is ApplyState.REFUSED


def test_effects_of_others_are_noticed_once_and_own_ones_never(qtbot, live, session):
    heard = []
    live.replaced.connect(heard.append)
    session.service.effects = SECOND
    cycles(live, 1.0, 2.0)
    assert heard == [SECOND]
    send(qtbot, live, session, FIRST)
    session.service.effects = FIRST
    cycles(live, 3.0, 4.0)
    assert heard == [SECOND]
