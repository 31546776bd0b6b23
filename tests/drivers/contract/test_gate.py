"""The gate blocks requests from before a stop, and a stop waits for at most one write."""

import threading

import pytest

from rotemina.drivers.contract import (
    Gate,
    GateError,
    PermitPurpose,
    StalePermitError,
    VirtualClock,
)


@pytest.fixture
def clock():
    return VirtualClock(1.0)


@pytest.fixture
def gate(clock):
    return Gate(clock)


def pass_gate(permit, **options):
    with permit.passing(**options):
        return True


@pytest.mark.parametrize("event", ["stop", "release", "start_connection"])
def test_an_earlier_permit_does_not_pass(gate, event):
    earlier_permit = gate.permit()
    assert pass_gate(earlier_permit)
    getattr(gate, event)()
    assert not earlier_permit.is_valid
    with pytest.raises(StalePermitError):
        pass_gate(earlier_permit)
    assert pass_gate(gate.permit())


def test_a_latch_blocks_motion_and_a_release_admits_only_later_permits(gate):
    gate.stop("emergency stop")
    permit_during_latch = gate.permit()
    assert gate.latch_reason == "emergency stop"
    with pytest.raises(StalePermitError, match="emergency stop is active; release it first"):
        pass_gate(permit_during_latch)
    gate.release()
    with pytest.raises(StalePermitError, match="try again"):
        pass_gate(permit_during_latch)
    assert pass_gate(gate.permit())


def test_an_enquiry_passes_after_a_stop_but_not_after_a_new_connection(gate):
    enquiry = gate.permit(PermitPurpose.ENQUIRY)
    gate.stop("emergency stop")
    assert pass_gate(enquiry)
    gate.start_connection()
    with pytest.raises(StalePermitError, match="connection"):
        pass_gate(enquiry)


def test_a_lock_blocks_only_the_start_of_a_motion(gate):
    permit = gate.permit()
    gate.lock_reason = lambda permit_to_check: (
        "parameters differ" if permit_to_check.purpose is PermitPurpose.MOTION else None
    )
    with pytest.raises(GateError, match="parameters differ"):
        pass_gate(permit)
    assert pass_gate(permit, begins=False)
    assert pass_gate(permit.with_purpose(PermitPurpose.SERVICE))


def test_a_permit_expires_with_its_lease(gate, clock):
    permit = gate.permit().with_deadline(1.5)
    clock.advance(0.5)
    assert pass_gate(permit)
    clock.advance(0.001)
    with pytest.raises(StalePermitError, match="lease"):
        pass_gate(permit)


def test_a_stop_never_happens_during_a_write(gate):
    """A stop from another thread during a write ends after the write."""
    order, writing = [], threading.Event()

    def stop():
        writing.wait()
        gate.stop()
        order.append("stopped")

    thread = threading.Thread(target=stop)
    thread.start()
    with gate.permit().passing():
        writing.set()
        # The thread cannot end during the write.
        thread.join(0.05)
        order.append("written")
    thread.join()
    assert order == ["written", "stopped"]
