"""The thread that calls a step at a fixed rate."""

import threading
from types import SimpleNamespace

import pytest

from rotemina.app.motion.device import Ticker, ticker as ticker_module

MAX_WAIT_S = 10.0


def test_it_calls_its_step_until_closed_and_can_be_closed_twice():
    calls = threading.Semaphore(0)
    ticker = Ticker("test", 1e-3, calls.release)
    ticker.start()
    ticker.start()
    for _ in range(3):
        assert calls.acquire(timeout=MAX_WAIT_S)
    ticker.close()
    ticker.close()
    assert not [thread for thread in threading.enumerate() if thread.name == "test"]


def test_a_step_that_raises_is_reported_and_the_next_one_is_called(caplog):
    errors, calls = [], threading.Semaphore(0)

    def step():
        calls.release()
        raise RuntimeError("a bad step")

    ticker = Ticker("test", 1e-3, step, errors.append)
    ticker.start()
    for _ in range(2):
        assert calls.acquire(timeout=MAX_WAIT_S)
    ticker.close()
    assert [str(error) for error in errors[:1]] == ["a bad step"]
    assert "a step failed" in caplog.text


def test_it_can_be_closed_from_its_own_step():
    done = threading.Event()
    ticker = None

    def step():
        ticker.close()
        done.set()

    ticker = Ticker("test", 1e-3, step)
    ticker.start()
    assert done.wait(MAX_WAIT_S)


def test_a_delay_is_not_made_up_for(monkeypatch, clock):
    """A step that takes ten periods is followed by a single step, not by ten."""
    monkeypatch.setattr(ticker_module, "time", SimpleNamespace(monotonic=clock))
    steps, pauses_s = [], []

    def step():
        steps.append(len(steps))
        if len(steps) == 2:
            clock.advance(10e-3)
        if len(steps) == 5:
            ticker.close()

    def wait(seconds):
        pauses_s.append(seconds)
        clock.advance(seconds)

    ticker = Ticker("test", 1e-3, step)
    monkeypatch.setattr(ticker._closing, "wait", wait)
    ticker.start()
    ticker._thread.join(MAX_WAIT_S)
    assert pauses_s == pytest.approx([1e-3, 0.0, 1e-3, 1e-3, 1e-3])
