"""The message log is bounded in size and can be filtered."""

import logging
import threading
from datetime import datetime

import pytest

from rotemina.app.shell.support import MessageLog
from rotemina.app.shell.support.message_log import MAX_MESSAGE_LENGTH, filter_messages
from rotemina.app.workbench import Level

NOON = datetime(2026, 3, 4, 12, 0, 0, 5000)


@pytest.fixture
def log():
    message_log = MessageLog(lambda: NOON, max_count=5)
    logger = logging.getLogger("rotemina.tested")
    logger.addHandler(message_log)
    yield message_log
    logger.removeHandler(message_log)


def test_records_of_the_log_arrive_with_level_and_source(log):
    logger = logging.getLogger("rotemina.tested.deep")
    logger.warning("%d °C", 40)
    try:
        raise KeyError("thx")
    except KeyError:
        logger.exception("failed")
    warning, error = log.messages()
    assert (warning.level, warning.source, warning.text) == (Level.WARNING, "tested.deep", "40 °C")
    assert error.level is Level.ERROR
    assert "KeyError: 'thx'" in error.text
    assert warning.line == "2026-03-04 12:00:00.005  warning  tested.deep: 40 °C"
    assert "\n    Traceback" in error.line


def test_a_notice_is_not_kept_twice(log):
    log.add_notice(Level.GOOD, "Saved")
    log.handle(
        logging.makeLogRecord({"name": "rotemina.app.workbench.notice_poster", "msg": "Saved"})
    )
    assert [(entry.level, entry.source) for entry in log.messages()] == [(Level.GOOD, "window")]


def test_memory_is_bounded_in_number_and_length(log):
    for number in range(20):
        log.add_notice(Level.INFO, f"{number} " + 3 * MAX_MESSAGE_LENGTH * "x")
    entries = log.messages()
    assert [entry.text.split()[0] for entry in entries] == ["15", "16", "17", "18", "19"]
    assert all(len(entry.text) < MAX_MESSAGE_LENGTH + 10 for entry in entries)
    assert log.count == 20


def test_an_invalid_log_call_is_ignored(log, monkeypatch):
    monkeypatch.setattr(logging, "raiseExceptions", False)
    bad = {"name": "other", "msg": "%d", "args": ("x",), "levelno": logging.ERROR}
    log.handle(logging.makeLogRecord(bad))
    assert log.messages() == ()


def test_messages_of_many_threads_are_all_counted():
    log = MessageLog(lambda: NOON)
    threads = [
        threading.Thread(target=lambda: [log.add_notice(Level.INFO, "x") for _ in range(200)])
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert log.count == len(log.messages()) == 800


def test_messages_are_filtered_by_level_and_words(log):
    log.add_notice(Level.INFO, "Connected to COM3")
    log.add_notice(Level.WARNING, "Line to COM3 is noisy")
    log.add_notice(Level.ERROR, "COM4 is gone")
    assert len(filter_messages(log.messages(), Level.INFO, "")) == 3
    assert [entry.text for entry in filter_messages(log.messages(), Level.WARNING, "com3")] == [
        "Line to COM3 is noisy"
    ]
    assert [entry.text for entry in filter_messages(log.messages(), Level.INFO, "IS com")] == [
        "Line to COM3 is noisy",
        "COM4 is gone",
    ]
    assert len(filter_messages(log.messages(), Level.ERROR, "WINDOW gone")) == 1
