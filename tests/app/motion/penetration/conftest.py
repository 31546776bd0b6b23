"""A penetration that tests step beside its session, on a clock set by hand."""

from datetime import UTC, datetime

import pytest

from rotemina.app.motion.penetration.arming import planned
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.penetration import Penetration
from rotemina.app.motion.penetration.run_log import RunLog
from rotemina.app.motion.penetration.status import Phase
from rotemina.drivers.samples import DeviceState

START = 64e-6
ENDS = {Phase.DONE, Phase.ABORTED, Phase.FAILED, Phase.HELD, Phase.DISARMED}


class Bench:
    """A session with a penetration beside it."""

    def __init__(self, stepped, log):
        self.stepped, self.session, self.clock = stepped, stepped.session, stepped.clock
        self.log = log
        self.penetration = Penetration(
            self.session, log, today=lambda: datetime(2026, 11, 21, tzinfo=UTC)
        )
        self.places = []  # of zn as commanded, and the phase

    @property
    def phase(self):
        return self.penetration.status.phase

    def ready(self, effects=(), start=START):
        """Put effects on the machine and the tip above the cell."""
        self.stepped.step()
        self.session.service.set_effects(list(effects))
        self.stepped.step()
        self.session.go_to({"zn": start})
        self.stepped.until(DeviceState.IDLE)
        self.stepped.step(0.02, 50)
        return self

    def arm(self, **parameters):
        self.penetration.arm(PenetrationParameters(**parameters), self.clock())
        return self

    def why_not(self, **parameters):
        asked = PenetrationParameters(**parameters)
        return self.penetration.why_not(asked, planned(self.session, asked))

    def press(self):
        self.penetration.press(self.clock())
        return self

    def step(self, seconds=0.02, times=1):
        for _ in range(times):
            state = self.stepped.step(seconds)
            self.penetration.step(self.clock())
            self.places.append((self.phase, state.command.get("zn"), dict(state.owners)))
        return self.penetration.status

    def until(self, *phases, limit_s=40.0):
        for _ in range(round(limit_s / 0.01)):
            if self.phase in phases:
                return self.penetration.status
            if self.phase in ENDS:
                break
            self.step(0.01)
        raise AssertionError(f"still {self.penetration.status}, {self.session.snapshot()}")

    def run(self, limit_s=40.0):
        return self.until(*ENDS, limit_s=limit_s)


@pytest.fixture
def bench(make_stepped, tmp_path):
    return Bench(make_stepped(), RunLog(tmp_path / "runs.jsonl"))


@pytest.fixture
def make_bench(make_stepped, tmp_path):
    def make(**options):
        return Bench(make_stepped(**options), RunLog(tmp_path / "runs.jsonl"))

    return make
