"""A penetration that a test steps together with its session, on a virtual clock."""

from datetime import UTC, datetime

import pytest

from rotemina.app.motion.penetration import (
    PenetrationController,
    PenetrationParameters,
    PenetrationPhase,
    RunLog,
    plan_session_thrust,
)
from rotemina.drivers.contract import DeviceState

START = 64e-6
ENDS = {
    PenetrationPhase.DONE,
    PenetrationPhase.ABORTED,
    PenetrationPhase.FAILED,
    PenetrationPhase.HELD,
    PenetrationPhase.DISARMED,
}


class PenetrationBench:
    """A session and a penetration."""

    def __init__(self, harness, log):
        self.harness, self.session, self.clock = harness, harness.session, harness.clock
        self.log = log
        self.penetration = PenetrationController(
            self.session, log, wall_clock=lambda: datetime(2026, 11, 21, tzinfo=UTC)
        )
        # Phase, commanded zn and owners after each step.
        self.history = []

    @property
    def phase(self):
        return self.penetration.status.phase

    def prepare(self, effects=(), start=START):
        """Apply effects to the machine, and move the tip above the cell."""
        self.harness.step()
        self.session.service.set_effects(list(effects))
        self.harness.step()
        self.session.go_to({"zn": start})
        self.harness.step_until(DeviceState.IDLE)
        self.harness.step(0.02, 50)
        return self

    def arm(self, **parameters):
        self.penetration.arm(PenetrationParameters(**parameters), self.clock())
        return self

    def find_refusal_reason(self, **parameters):
        requested = PenetrationParameters(**parameters)
        return self.penetration.find_refusal_reason(
            requested, plan_session_thrust(self.session, requested)
        )

    def press(self):
        self.penetration.press_button(self.clock())
        return self

    def step(self, seconds=0.02, times=1):
        for _ in range(times):
            state = self.harness.step(seconds)
            self.penetration.step(self.clock())
            self.history.append((self.phase, state.command.get("zn"), dict(state.owners)))
        return self.penetration.status

    def step_until(self, *phases, limit_s=40.0):
        for _ in range(round(limit_s / 0.01)):
            if self.phase in phases:
                return self.penetration.status
            if self.phase in ENDS:
                break
            self.step(0.01)
        raise AssertionError(f"still {self.penetration.status}, {self.session.snapshot()}")

    def run(self, limit_s=40.0):
        return self.step_until(*ENDS, limit_s=limit_s)


@pytest.fixture
def bench(make_harness, tmp_path):
    return PenetrationBench(make_harness(), RunLog(tmp_path / "runs.jsonl"))


@pytest.fixture
def make_bench(make_harness, tmp_path):
    def make(**options):
        return PenetrationBench(make_harness(**options), RunLog(tmp_path / "runs.jsonl"))

    return make
