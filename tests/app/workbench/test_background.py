"""Background jobs: order, answers and released memory."""

import gc
import threading
import weakref

import pytest
from PySide6.QtCore import QCoreApplication, QObject

from rotemina.app.workbench import BackgroundWorker
from rotemina.sim.errors import InputError

TIMEOUT_MS = 30_000


class LargeObject:
    """Stands for a large object such as a record."""


@pytest.fixture
def background(qtbot):
    parent = QObject()
    worker = BackgroundWorker(parent)
    yield worker
    assert worker.wait()


def test_jobs_run_in_order_and_only_the_latest_of_a_kind_answers(qtbot, background):
    may_run, runs, answers = threading.Event(), [], []

    def work(number):
        assert may_run.wait(20.0)
        runs.append((number, threading.current_thread() is threading.main_thread()))
        return number

    for number, kind in enumerate(("a", "a", "b")):
        background.run(kind, lambda number=number: work(number), answers.append, answers.append)
    assert background.busy
    may_run.set()
    qtbot.waitUntil(lambda: not background.busy, timeout=TIMEOUT_MS)
    assert runs == [(0, False), (1, False), (2, False)]
    assert answers == [1, 2]


def test_refusals_and_faults_are_reported(qtbot, background, caplog):
    messages = []
    for number, error in enumerate((InputError("short"), InputError(), ZeroDivisionError("by 0"))):

        def work(error=error):
            raise error

        background.run(str(number), work, print, messages.append)
    qtbot.waitUntil(lambda: len(messages) == 3, timeout=TIMEOUT_MS)
    assert messages[:2] == ["short", "InputError"]
    assert "ZeroDivisionError: by 0" in messages[2]


def test_finished_jobs_release_their_memory(qtbot, background):
    references = []
    for _ in range(5):
        large_object = LargeObject()
        references.append(weakref.ref(large_object))
        results = []
        background.run("any", lambda large_object=large_object: large_object, results.append, print)
        del large_object
        qtbot.waitUntil(lambda results=results: bool(results), timeout=TIMEOUT_MS)
        del results
    assert background.wait()
    gc.collect()
    assert [reference for reference in references if reference() is not None] == []


def test_no_answer_arrives_after_the_end(qtbot, background):
    answers, may_run = [], threading.Event()
    background.run("slow", lambda: may_run.wait(20.0), answers.append, answers.append)
    may_run.set()
    assert background.end()
    QCoreApplication.processEvents()
    assert answers == []
    assert not background._latest_numbers  # no kind of a discarded request is kept
    background.run("next", lambda: "answer", answers.append, answers.append)
    qtbot.waitUntil(lambda: answers == ["answer"], timeout=TIMEOUT_MS)
