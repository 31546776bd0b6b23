"""What the program told: kept within bounds, to be filtered."""

import logging
import threading
from datetime import datetime

import pytest

from rotemina.app.shell.message_log import LONGEST, MessageLog, chosen
from rotemina.app.shell.workbench import Level

NOON = datetime(2026, 3, 4, 12, 0, 0, 5000)


@pytest.fixture
def log():
    made = MessageLog(lambda: NOON, most=5)
    logger = logging.getLogger("rotemina.tested")
    logger.addHandler(made)
    yield made
    logger.removeHandler(made)


def test_records_of_the_log_arrive_with_level_and_source(log):
    logger = logging.getLogger("rotemina.tested.deep")
    logger.warning("%d °C", 40)
    try:
        raise KeyError("thx")
    except KeyError:
        logger.exception("failed")
    warning, error = log.messages()
    assert (warning.level, warning.source, warning.text) == (
        Level.WARNING,
        "tested.deep",
        "40 °C",
    )
    assert error.level is Level.ERROR
    assert "KeyError: 'thx'" in error.text
    assert warning.line == "2026-03-04 12:00:00.005  warning  tested.deep: 40 °C"
    assert "\n    Traceback" in error.line


def test_a_notice_is_not_kept_twice(log):
    log.notice(Level.GOOD, "Saved")
    log.handle(logging.makeLogRecord({"name": "rotemina.app.shell.workbench", "msg": "Saved"}))
    assert [(each.level, each.source) for each in log.messages()] == [(Level.GOOD, "window")]


def test_memory_is_bounded_in_number_and_length(log):
    for number in range(20):
        log.notice(Level.INFO, f"{number} " + 3 * LONGEST * "x")
    kept = log.messages()
    assert [each.text.split()[0] for each in kept] == ["15", "16", "17", "18", "19"]
    assert all(len(each.text) < LONGEST + 10 for each in kept)
    assert log.count == 20


def test_a_badly_written_log_call_ends_nothing(log, monkeypatch):
    monkeypatch.setattr(logging, "raiseExceptions", False)
    bad = {"name": "other", "msg": "%d", "args": ("x",), "levelno": logging.ERROR}
    log.handle(logging.makeLogRecord(bad))
    assert log.messages() == ()


def test_messages_of_many_threads_are_all_counted():
    log = MessageLog(lambda: NOON)
    threads = [
        threading.Thread(target=lambda: [log.notice(Level.INFO, "x") for _ in range(200)])
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert log.count == len(log.messages()) == 800


def test_messages_are_chosen_by_gravity_and_words(log):
    log.notice(Level.INFO, "Connected to COM3")
    log.notice(Level.WARNING, "Line to COM3 is noisy")
    log.notice(Level.ERROR, "COM4 is gone")
    assert len(chosen(log.messages(), Level.INFO, "")) == 3
    assert [each.text for each in chosen(log.messages(), Level.WARNING, "com3")] == [
        "Line to COM3 is noisy"
    ]
    assert [each.text for each in chosen(log.messages(), Level.INFO, "IS com")] == [
        "Line to COM3 is noisy",
        "COM4 is gone",
    ]
    assert len(chosen(log.messages(), Level.ERROR, "WINDOW gone")) == 1
