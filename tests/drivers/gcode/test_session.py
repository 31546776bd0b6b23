"""A motion session with the G-code stage, from homing to a stop."""

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionPhase
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError


class SessionBench:
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

    def wait_for_rest(self, limit_s=60.0):
        for _ in range(round(limit_s / 0.1)):
            state = self.run(0.1)
            if state.activity is DeviceState.IDLE and not state.queued and not state.stopping:
                return state
        raise AssertionError(f"still {state.phase}")


def test_the_stage_homes_jogs_moves_and_stops(make_bench):
    bench = make_bench()
    session_bench = SessionBench(bench)
    session = session_bench.session
    assert session_bench.run(0.2).phase is SessionPhase.POSITION_UNKNOWN
    with pytest.raises(InputError, match="home"):
        session.jog("x", 1e-3)
    session.home()
    state = session_bench.wait_for_rest()
    assert state.phase is SessionPhase.READY
    session.jog("x", 1e-3)
    assert session_bench.wait_for_rest().command["x"] == pytest.approx(2e-3, abs=1e-9)
    session.go_to({"x": 0.03, "y": 0.02})
    session_bench.run(1.0)
    session.stop("a test")
    state = session_bench.wait_for_rest()
    assert 0.004 < state.command["x"] < 0.02
    assert state.phase is SessionPhase.READY
    assert state.command["x"] * 1e3 == pytest.approx(bench.stage.true_positions[0], abs=1e-3)
    session.close()
