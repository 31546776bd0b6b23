"""Work away from the window's thread: its order, its answers, and that nothing of it stays."""

import gc
import threading
import weakref

import pytest
from PySide6.QtCore import QCoreApplication, QObject

from rotemina.app.shell.background import Background
from rotemina.sim.errors import InputError

PANELS = ()

LONG_MS = 30_000


class Heavy:
    """What a record is: large."""


@pytest.fixture
def background(qtbot):
    parent = QObject()
    made = Background(parent)
    yield made
    assert made.wait()


def test_work_is_done_in_order_and_only_the_latest_of_a_kind_is_answered(qtbot, background):
    go, order, answers = threading.Event(), [], []

    def work(number):
        assert go.wait(20.0)
        order.append((number, threading.current_thread() is threading.main_thread()))
        return number

    for number, kind in enumerate(("a", "a", "b")):
        background.run(kind, lambda number=number: work(number), answers.append, answers.append)
    assert background.busy
    go.set()
    qtbot.waitUntil(lambda: not background.busy, timeout=LONG_MS)
    assert order == [(0, False), (1, False), (2, False)]
    assert answers == [1, 2]


def test_a_refusal_and_a_fault_are_told(qtbot, background, caplog):
    told = []
    for error in (InputError("too short"), ZeroDivisionError("by zero")):

        def work(error=error):
            raise error

        background.run(error.args[0], work, print, told.append)
    qtbot.waitUntil(lambda: len(told) == 2, timeout=LONG_MS)
    assert told[0] == "too short"
    assert "ZeroDivisionError: by zero" in told[1]


def test_nothing_of_what_was_done_stays(qtbot, background):
    alive = []
    for _ in range(50):
        heavy = Heavy()
        alive.append(weakref.ref(heavy))
        done = []
        background.run("any", lambda heavy=heavy: heavy, done.append, print)
        del heavy
        qtbot.waitUntil(lambda done=done: bool(done), timeout=LONG_MS)
        del done
    assert background.wait()
    gc.collect()
    assert [one for one in alive if one() is not None] == []


def test_no_answer_arrives_after_the_end(qtbot, background):
    answers, go = [], threading.Event()
    background.run("slow", lambda: go.wait(20.0), answers.append, answers.append)
    go.set()
    assert background.end()
    QCoreApplication.processEvents()
    assert answers == []
    background.run("next", lambda: "answer", answers.append, answers.append)
    qtbot.waitUntil(lambda: answers == ["answer"], timeout=LONG_MS)
