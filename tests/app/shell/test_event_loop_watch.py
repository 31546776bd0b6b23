"""How late the window is, and what is said of a moment in which it stands still."""

import logging
import threading
import weakref

import pytest

from rotemina.app.shell.event_loop_watch import PERIOD_S, LoopWatch, thread_calls
from rotemina.app.shell.reaction_times import Latenesses

PANELS = ()


class Clock:
    now_s = 10.0

    def __call__(self):
        return self.now_s


def test_beats_in_time_are_late_by_nothing():
    measured = Latenesses(0.02)
    for _ in range(100):
        measured.add(0.02)
    assert measured.summary().worst_s == 0.0
    assert measured.percentile(0.99) == 0.0
    assert measured.summary().watched_s == pytest.approx(2.0)


def test_a_stall_counts_as_all_the_beats_that_it_swallowed():
    measured = Latenesses(0.02)
    for _ in range(950):
        measured.add(0.02)
    measured.add(1.02)  # 51 beats were due: they were late by 1 s, 0.98 s, …, 0 s
    assert measured.summary().worst_s == pytest.approx(1.0)
    assert measured.percentile(0.99) == pytest.approx(0.8, abs=0.03)
    assert measured.percentile(0.9) < 0.01


def stand_still(watch, clock):
    clock.now_s += 0.4
    looking = threading.Thread(target=watch.look)
    looking.start()
    looking.join()
    clock.now_s += 0.1


def test_a_stall_is_logged_with_the_calls_that_the_window_was_in(qtbot, caplog):
    clock = Clock()
    worked = Clock()
    watch = LoopWatch(clock=clock, worked=worked)
    clock.now_s += PERIOD_S
    watch.beat()
    worked.now_s += 0.07
    watch.look()  # nothing is overdue
    with caplog.at_level(logging.WARNING):
        stand_still(watch, clock)
        watch.beat()
    (stall,) = watch.stalls
    assert stall.lasted_s == pytest.approx(0.5 - PERIOD_S)
    assert stall.worked_s == pytest.approx(0.07)
    assert "did not react for 0.48 s, and worked 0.07 s of that" in caplog.text
    assert stall.calls[-1].startswith("  threading:")  # where this thread waited for the other
    # A stall during which nobody could look is not given the calls of the one before.
    clock.now_s += 0.5
    watch.beat()
    assert "cannot be told" in watch.stalls[-1].calls[0]
    watch.restart()
    assert not watch.stalls
    assert watch.lateness.watched_s == 0.0


def test_a_window_that_is_always_late_does_not_fill_the_log(qtbot, caplog):
    clock = Clock()
    watch = LoopWatch(clock=clock)
    for _ in range(130):
        clock.now_s += 0.5 + PERIOD_S
        watch.beat()
    told = [record.getMessage() for record in caplog.records]
    assert len(told) == 2
    assert "(and 115 times since the last word, up to 0.50 s)" in told[1]


def test_the_calls_of_a_thread_are_read_without_keeping_what_it_has():
    class Painter:
        pass

    began, goes_on, left = threading.Event(), threading.Event(), []

    def paint_something():
        painter = Painter()
        left.append(weakref.ref(painter))
        began.set()
        goes_on.wait(30.0)

    thread = threading.Thread(target=paint_something)
    thread.start()
    assert began.wait(30.0)
    calls = thread_calls(thread.ident)
    assert calls[-1].startswith("  threading:")
    assert calls[-1].endswith(" wait")
    assert not thread_calls(0)  # no such thread
    goes_on.set()
    thread.join(30.0)
    assert left[0]() is None


def test_a_watch_beats_by_itself_until_it_is_closed(qtbot):
    watch = LoopWatch()
    watch.start()
    qtbot.waitUntil(lambda: watch.lateness.watched_s > 0.0, timeout=30_000)
    watch.close()
    watch.close()
    assert not [one for one in threading.enumerate() if one.name == "loop watch"]


def test_the_log_page_and_the_bundle_tell_how_late_the_window_was(qtbot, window):
    for _ in range(10):
        window.loop_watch.beat()
    window.show_log()
    assert window.log_page.lateness.text().startswith("Window delay:")
    window.log_page.close()
    window.show_support()
    page = window._support
    qtbot.waitUntil(lambda: bool(page.items), timeout=30_000)
    (told,) = [item.text for item in page.items if item.name == "window.json"]
    assert "late_99_percent_ms" in told
    page.close()
