"""The thread that calls a step at a fixed rate."""

import threading

import pytest

from rotemina.app.motion.device import Ticker

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


@pytest.mark.parametrize("period_s", [1e-3])
def test_a_delay_is_not_made_up_for(period_s):
    """A step that takes ten periods is followed by a single step, not by ten."""
    times, third_call = [], threading.Event()
    gate = threading.Event()

    def step():
        times.append(len(times))
        if len(times) == 1:
            gate.wait(0.02)
        if len(times) >= 3:
            third_call.set()

    ticker = Ticker("test", period_s, step)
    ticker.start()
    gate.set()
    assert third_call.wait(MAX_WAIT_S)
    ticker.close()
