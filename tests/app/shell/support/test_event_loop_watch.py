"""The event loop watch measures delays and logs stalls."""

import logging
import threading
import weakref

import pytest

from rotemina.app.shell.support import EventLoopWatch
from rotemina.app.shell.support.event_loop_watch import BEAT_PERIOD_S, find_thread_calls
from rotemina.app.shell.support.reaction_times import LatenessHistogram


class Clock:
    now_s = 10.0

    def __call__(self):
        return self.now_s


def test_punctual_beats_have_no_delay():
    histogram = LatenessHistogram(0.02)
    for _ in range(100):
        histogram.add(0.02)
    assert histogram.summarise().worst_s == 0.0
    assert histogram.find_percentile(0.99) == 0.0
    assert histogram.summarise().duration_s == pytest.approx(2.0)


def test_a_stall_counts_every_missed_beat():
    histogram = LatenessHistogram(0.02)
    for _ in range(950):
        histogram.add(0.02)
    histogram.add(1.02)  # 51 beats were due: they were late by 1 s, 0.98 s, …, 0 s
    assert histogram.summarise().worst_s == pytest.approx(1.0)
    assert histogram.find_percentile(0.99) == pytest.approx(0.8, abs=0.03)
    assert histogram.find_percentile(0.9) < 0.01


def simulate_stall(watch, clock):
    clock.now_s += 0.4
    sampler = threading.Thread(target=watch.sample_overdue_thread)
    sampler.start()
    sampler.join()
    clock.now_s += 0.1


def test_a_stall_is_logged_with_the_calls_it_occurred_in(qtbot, caplog):
    clock = Clock()
    cpu_clock = Clock()
    watch = EventLoopWatch(clock=clock, cpu_time=cpu_clock)
    clock.now_s += BEAT_PERIOD_S
    watch.beat()
    cpu_clock.now_s += 0.07
    watch.sample_overdue_thread()  # nothing is overdue
    with caplog.at_level(logging.WARNING):
        simulate_stall(watch, clock)
        watch.beat()
    (stall,) = watch.stalls
    assert stall.duration_s == pytest.approx(0.5 - BEAT_PERIOD_S)
    assert stall.cpu_time_s == pytest.approx(0.07)
    assert "did not react for 0.48 s and used 0.07 s of processor time" in caplog.text
    assert stall.calls[-1].startswith("  threading:")  # where this thread waited for the sampler
    # A stall that was not sampled does not get the calls of the previous one.
    clock.now_s += 0.5
    watch.beat()
    assert "cause unknown" in watch.stalls[-1].calls[0]
    watch.restart()
    assert not watch.stalls
    assert watch.lateness.duration_s == 0.0


def test_a_window_that_is_always_late_does_not_fill_the_log(qtbot, caplog):
    clock = Clock()
    watch = EventLoopWatch(clock=clock)
    for _ in range(130):
        clock.now_s += 0.5 + BEAT_PERIOD_S
        watch.beat()
    messages = [record.getMessage() for record in caplog.records]
    assert len(messages) == 2
    assert "(and 115 stalls since the last report, up to 0.50 s)" in messages[1]


def test_reading_a_threads_calls_keeps_no_references():
    class Painter:
        pass

    started, resume, references = threading.Event(), threading.Event(), []

    def paint_something():
        painter = Painter()
        references.append(weakref.ref(painter))
        started.set()
        resume.wait(30.0)

    thread = threading.Thread(target=paint_something)
    thread.start()
    assert started.wait(30.0)
    calls = find_thread_calls(thread.ident)
    assert calls[-1].startswith("  threading:")
    assert calls[-1].endswith(" wait")
    assert not find_thread_calls(0)  # no such thread
    resume.set()
    thread.join(30.0)
    assert references[0]() is None


def test_a_watch_beats_by_itself_until_it_is_closed(qtbot):
    watch = EventLoopWatch()
    watch.start()
    qtbot.waitUntil(lambda: watch.lateness.duration_s > 0.0, timeout=30_000)
    watch.close()
    watch.close()
    assert not [thread for thread in threading.enumerate() if thread.name == "loop watch"]
