"""A motion session over the G-code stage: what an operator does, from homing to a stop."""

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Phase
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError


class Seat:
    def __init__(self, bench):
        self.bench = bench
        self.session = MotionSession(bench.driver)
        self.session.connect()
        self.session.run_once()

    def run(self, seconds):
        for _ in range(round(seconds / 0.005)):
            self.bench.clock.advance(0.005)
            self.session.run_once()
        return self.session.snapshot()

    def rest(self, limit_s=60.0):
        for _ in range(round(limit_s / 0.1)):
            state = self.run(0.1)
            if state.activity is DeviceState.IDLE and not state.queued and not state.stopping:
                return state
        raise AssertionError(f"still {state.phase}")


@pytest.fixture
def seat(joined):
    made = Seat(joined())
    yield made
    made.session.close()


def test_it_is_homed_jogged_sent_stopped_and_refuses_what_it_cannot(seat):
    session = seat.session
    assert seat.run(0.2).phase is Phase.POSITION_UNKNOWN
    with pytest.raises(InputError, match="home"):
        session.jog("x", 1e-3)
    session.home()
    state = seat.rest()
    assert state.phase is Phase.READY
    session.jog("x", 1e-3)
    assert seat.rest().command["x"] == pytest.approx(2e-3, abs=1e-9)
    session.go_to({"x": 0.03, "y": 0.02})
    seat.run(1.0)
    session.stop("a test")
    state = seat.rest()
    assert 0.004 < state.command["x"] < 0.02
    assert state.phase is Phase.READY
    assert state.command["x"] * 1e3 == pytest.approx(seat.bench.stage.true[0], abs=1e-3)


def test_a_fault_is_told_cleared_and_wants_homing(seat):
    session = seat.session
    session.home()
    seat.rest()
    seat.bench.stage.hit_limit()
    state = seat.run(0.5)
    assert "hard limit" in state.fault
    session.service.clear_fault()
    state = seat.run(0.5)
    assert (state.fault, state.phase) == (None, Phase.POSITION_UNKNOWN)
