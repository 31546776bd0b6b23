"""The thread that keeps a rate."""

import threading

import pytest

from rotemina.app.motion.ticker import Ticker

LONG_S = 10.0


def test_it_calls_until_it_is_closed_and_is_closed_twice_safely():
    thrice = threading.Semaphore(0)
    ticker = Ticker("test", 1e-3, thrice.release)
    ticker.start()
    ticker.start()
    for _ in range(3):
        assert thrice.acquire(timeout=LONG_S)
    ticker.close()
    ticker.close()
    assert not [thread for thread in threading.enumerate() if thread.name == "test"]


def test_a_step_that_raises_is_told_and_the_next_one_is_called(caplog):
    told, called = [], threading.Semaphore(0)

    def step():
        called.release()
        raise RuntimeError("a bad step")

    ticker = Ticker("test", 1e-3, step, told.append)
    ticker.start()
    for _ in range(2):
        assert called.acquire(timeout=LONG_S)
    ticker.close()
    assert [str(error) for error in told[:1]] == ["a bad step"]
    assert "a step failed" in caplog.text


def test_it_may_be_closed_from_its_own_step():
    done = threading.Event()
    ticker = None

    def step():
        ticker.close()
        done.set()

    ticker = Ticker("test", 1e-3, step)
    ticker.start()
    assert done.wait(LONG_S)


@pytest.mark.parametrize("period_s", [1e-3])
def test_what_is_late_is_not_made_up_for(period_s):
    """A step that takes ten periods is followed by one step, not by ten."""
    times, enough = [], threading.Event()
    gate = threading.Event()

    def step():
        times.append(len(times))
        if len(times) == 1:
            gate.wait(0.02)
        if len(times) >= 3:
            enough.set()

    ticker = Ticker("test", period_s, step)
    ticker.start()
    gate.set()
    assert enough.wait(LONG_S)
    ticker.close()
