"""What becomes an entry of the history, and what is only counted."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from PySide6.QtCore import QTranslator

from rotemina.app.motion.state import (
    CommandRefused,
    Connection,
    Faulted,
    SessionState,
    StateChanged,
)
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.faults.fault_history import MOST, History, Kind, as_text

BEGIN = datetime(2026, 3, 1, 12, 0, 0, 250_000, tzinfo=UTC)
SOUND = SessionState(
    connection=Connection.CONNECTED, activity=DeviceState.IDLE, position_known=True
)


@pytest.fixture
def history():
    return History()


def tell(history, *events):
    for second, event in enumerate(events):
        history.note_event(BEGIN + timedelta(seconds=second), event)
    return [(entry.kind, replace(entry, count=1).told) for entry in history.entries]


def changed(**changes):
    values = {name: getattr(SOUND, name) for name in ("connection", "activity", "position_known")}
    return StateChanged(SessionState(**{**values, **changes}))


CONNECTING = changed(connection=Connection.CONNECTING, activity=DeviceState.CLOSED)
FAILED = changed(connection=Connection.FAILED, activity=DeviceState.CLOSED, fault="gone")
GONE = changed(connection=Connection.DISCONNECTED, activity=DeviceState.CLOSED)
CONNECTED = StateChanged(SOUND)


def test_a_device_that_was_never_there_is_no_lost_one(history):
    assert tell(history, CONNECTING, FAILED, Faulted("gone")) == [(Kind.FAILED, "gone")]


def test_a_lost_device_and_its_return(history):
    told = tell(history, CONNECTING, CONNECTED, FAILED, Faulted("gone"), CONNECTING, CONNECTED)
    assert told == [(Kind.LOST, "gone"), (Kind.RECOVERED, "connected")]
    assert history.entries[-1].count == 2  # connected before, and again


def test_a_fault_and_its_end(history):
    hot = changed(fault="hot", activity=DeviceState.FAULT)
    told = tell(history, CONNECTED, hot, Faulted("hot"), CONNECTED)
    assert told[1:] == [(Kind.FAULT, "hot"), (Kind.RECOVERED, "cleared: hot")]


def test_a_short_loss_that_comes_and_goes_takes_two_rows(history):
    events = [CONNECTED]
    for _ in range(20):
        events += [changed(silent_s=0.1), CONNECTED]
    told = tell(history, *events)
    assert [kind for kind, _ in told] == [Kind.RECOVERED, Kind.LOST, Kind.RECOVERED]
    assert [entry.count for entry in history.entries] == [1, 20, 20]
    assert history.entries[-1].at == BEGIN + timedelta(seconds=40)


def test_disconnecting_is_no_fault(history):
    assert tell(history, CONNECTED, GONE)[-1] == (Kind.NOTE, "disconnected")


def test_refusals_are_counted_where_they_repeat(history):
    tell(history, *[CommandRefused("too far")] * 3)
    (entry,) = history.entries
    assert entry.told == "too far (3 times)"


def test_the_latch_is_noted_once(history):
    for latched in (None, "emergency stop", "emergency stop", None):
        history.note_latch(BEGIN, latched)
    assert [entry.told for entry in history.entries] == ["emergency stop locked", "released"]


def test_old_entries_give_way(history):
    for number in range(MOST + 10):
        history.add(BEGIN, Kind.NOTE, f"number {number}")
    assert len(history.entries) == MOST
    assert history.entries[0].text == "number 10"


def test_as_text_every_entry_is_one_line(history):
    history.add(BEGIN, Kind.FAULT, "two\nlines <b>")
    assert as_text(history.entries) == "2026-03-01 12:00:00.250+0000\tfault\ttwo lines <b>\n"


def test_an_entry_is_kept_in_english_whatever_the_window_speaks(qapp):
    class Loud(QTranslator):
        def translate(self, _context, text, _comment=None, _number=-1):
            return text.upper().replace("{ABOUT}", "{about}").replace("{TEXT}", "{text}")

    loud = Loud()
    qapp.installTranslator(loud)
    history = History()
    history.add(BEGIN, Kind.RECOVERED, "cleared: {about}", "it {about} hangs")
    (entry,) = history.entries
    assert entry.shown == "CLEARED: IT {about} HANGS"
    assert entry.told == "cleared: it {about} hangs"
    assert "\trecovered\tcleared: it" in str(entry)
    qapp.removeTranslator(loud)
