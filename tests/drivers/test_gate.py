"""The gate: what passes, what does not, and that a stop waits for one write at most."""

import threading

import pytest

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.gate import Gate, GateError, OvertakenError, Purpose


@pytest.fixture
def clock():
    return VirtualClock(1.0)


@pytest.fixture
def gate(clock):
    return Gate(clock)


def passes(permit, **how):
    with permit.passing(**how):
        return True


@pytest.mark.parametrize("event", ["stop", "release", "reconnected"])
def test_what_was_asked_for_before_does_not_pass(gate, event):
    before = gate.permit()
    assert passes(before)
    getattr(gate, event)()
    assert not before.valid
    with pytest.raises(OvertakenError):
        passes(before)
    assert passes(gate.permit())


def test_a_latch_lets_nothing_move_and_a_release_lets_only_what_comes_after_it(gate):
    gate.stop("emergency stop")
    meanwhile = gate.permit()
    assert gate.latched == "emergency stop"
    with pytest.raises(OvertakenError, match="emergency stop is active; release it first"):
        passes(meanwhile)
    gate.release()
    with pytest.raises(OvertakenError, match="try again"):
        passes(meanwhile)
    assert passes(gate.permit())


def test_a_question_passes_after_a_stop_but_not_on_another_connection(gate):
    question = gate.permit(Purpose.ENQUIRY)
    gate.stop("emergency stop")
    assert passes(question)
    gate.reconnected()
    with pytest.raises(OvertakenError, match="connection"):
        passes(question)


def test_what_locks_motion_is_asked_where_a_motion_begins_not_where_one_goes_on(gate):
    permit = gate.permit()
    gate.locks = lambda asked: "parameters differ" if asked.purpose is Purpose.MOTION else None
    with pytest.raises(GateError, match="parameters differ"):
        passes(permit)
    assert passes(permit, begins=False)
    assert passes(permit.meant_for(Purpose.SERVICE))


def test_a_lease_ends(gate, clock):
    permit = gate.permit().until(1.5)
    clock.advance(0.5)
    assert passes(permit)
    clock.advance(0.001)
    with pytest.raises(OvertakenError, match="lease"):
        passes(permit)


def test_a_stop_comes_before_a_write_or_after_it_and_never_in_the_middle(gate):
    """A stop from another thread, asked for while a write is under way, ends after the write."""
    order, writing = [], threading.Event()

    def stop():
        writing.wait()
        gate.stop()
        order.append("stopped")

    thread = threading.Thread(target=stop)
    thread.start()
    with gate.permit().passing():
        writing.set()
        thread.join(0.05)  # it cannot end: the gate is held open
        order.append("written")
    thread.join()
    assert order == ["written", "stopped"]
