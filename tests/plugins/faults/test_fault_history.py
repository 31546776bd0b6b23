"""Which events become entries of the fault history, and which are only counted."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from PySide6.QtCore import QTranslator

from rotemina.app.motion.state import (
    CommandRefused,
    ConnectionState,
    FaultRaised,
    SessionState,
    StateChanged,
)
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.faults.fault_history import (
    MAX_ENTRIES,
    FaultHistory,
    FaultKind,
    format_entries,
)

START = datetime(2026, 3, 1, 12, 0, 0, 250_000, tzinfo=UTC)
CONNECTED_STATE = SessionState(
    connection=ConnectionState.CONNECTED, activity=DeviceState.IDLE, position_known=True
)


@pytest.fixture
def history():
    return FaultHistory()


def note_events(history, *events):
    for second, event in enumerate(events):
        history.record_event(START + timedelta(seconds=second), event)
    return [(entry.kind, replace(entry, count=1).english_text) for entry in history.entries]


def make_state_changed(**changes):
    values = {
        name: getattr(CONNECTED_STATE, name)
        for name in ("connection", "activity", "position_known")
    }
    return StateChanged(SessionState(**{**values, **changes}))


CONNECTING = make_state_changed(connection=ConnectionState.CONNECTING, activity=DeviceState.CLOSED)
FAILED = make_state_changed(
    connection=ConnectionState.FAILED, activity=DeviceState.CLOSED, fault="gone"
)
DISCONNECTED = make_state_changed(
    connection=ConnectionState.DISCONNECTED, activity=DeviceState.CLOSED
)
CONNECTED = StateChanged(CONNECTED_STATE)


def test_a_device_that_never_connected_has_failed_and_is_not_lost(history):
    assert note_events(history, CONNECTING, FAILED, FaultRaised("gone")) == [
        (FaultKind.CONNECTION_FAILED, "gone")
    ]


def test_a_lost_device_and_its_reconnection_are_recorded(history):
    entries = note_events(
        history, CONNECTING, CONNECTED, FAILED, FaultRaised("gone"), CONNECTING, CONNECTED
    )
    assert entries == [(FaultKind.LOST, "gone"), (FaultKind.RECOVERED, "connected")]
    assert history.entries[-1].count == 2  # first connection and reconnection


def test_a_fault_and_its_end_are_recorded(history):
    hot_fault = make_state_changed(fault="hot", activity=DeviceState.FAULT)
    entries = note_events(history, CONNECTED, hot_fault, FaultRaised("hot"), CONNECTED)
    assert entries[1:] == [(FaultKind.FAULT, "hot"), (FaultKind.RECOVERED, "cleared: hot")]


def test_repeated_short_losses_take_two_rows(history):
    events = [CONNECTED]
    for _ in range(20):
        events += [make_state_changed(silent_s=0.1), CONNECTED]
    entries = note_events(history, *events)
    assert [kind for kind, _ in entries] == [
        FaultKind.RECOVERED,
        FaultKind.LOST,
        FaultKind.RECOVERED,
    ]
    assert [entry.count for entry in history.entries] == [1, 20, 20]
    assert history.entries[-1].at == START + timedelta(seconds=40)


def test_refusals_are_counted_latches_noted_once_and_disconnecting_is_no_fault(history):
    note_events(history, *[CommandRefused("too far")] * 3)
    for latched in (None, "emergency stop", "emergency stop", None):
        history.record_latch(START, latched)
    note_events(history, CONNECTED, DISCONNECTED)
    assert [(entry.kind, entry.english_text) for entry in history.entries] == [
        (FaultKind.REFUSED, "too far (3 times)"),
        (FaultKind.STOP, "emergency stop locked"),
        (FaultKind.STOP, "released"),
        (FaultKind.RECOVERED, "connected"),
        (FaultKind.NOTE, "disconnected"),
    ]


def test_the_oldest_entries_are_dropped(history):
    for number in range(MAX_ENTRIES + 10):
        history.add(START, FaultKind.NOTE, f"number {number}")
    assert len(history.entries) == MAX_ENTRIES
    assert history.entries[0].text == "number 10"


def test_each_entry_is_written_as_one_line(history):
    history.add(START, FaultKind.FAULT, "two\nlines <b>")
    assert format_entries(history.entries) == "2026-03-01 12:00:00.250+0000\tfault\ttwo lines <b>\n"


def test_entries_keep_the_english_text_next_to_the_translation(qapp):
    class UpperCaseTranslator(QTranslator):
        def translate(self, _context, text, _comment=None, _number=-1):
            return text.upper().replace("{ABOUT}", "{about}").replace("{TEXT}", "{text}")

    translator = UpperCaseTranslator()
    qapp.installTranslator(translator)
    history = FaultHistory()
    history.add(START, FaultKind.RECOVERED, "cleared: {about}", "it {about} hangs")
    (entry,) = history.entries
    assert entry.shown_text == "CLEARED: IT {about} HANGS"
    assert entry.english_text == "cleared: it {about} hangs"
    assert "\trecovered\tcleared: it" in str(entry)
    qapp.removeTranslator(translator)
