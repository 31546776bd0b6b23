"""The bench hands a panel a record, and plays a trajectory for it."""

import numpy as np
import pytest
from PySide6.QtWidgets import QLabel

from rotemina.app.motion.state import Phase
from rotemina.app.panel import Panel
from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

pytestmark = pytest.mark.usefixtures("qapp")


class Listener(Panel):
    title = "Listener"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.text, self.plans, self.moved = QLabel(), [], set()
        workbench.plan_changed.connect(self.take_plan)
        workbench.run_changed.connect(self.take_run)
        workbench.shown.connect(self.take_state)

    def take_plan(self, plan):
        self.plans.append(plan.name)

    def take_run(self, run):
        self.text.setText(f"{run.name}: {len(run.record.time_s)} rows")

    def take_state(self, state):
        self.moved.add(round(1e9 * state.command["zn"]))


def swing(height=5e-6, signals=(Tap.CMD,)):
    time_s = np.arange(251) / 500.0
    path = 3e-5 + height * np.sin(np.pi * time_s / time_s[-1]) ** 4
    return Record.from_signals(time_s, {("zn", tap): path for tap in signals}, {"zn": "m"})


def test_a_trajectory_is_planned_played_and_compared():
    with panel_bench(Listener) as bench:
        run = bench.play(swing(), "swing")
        assert bench.panel.plans == ["swing"]
        assert bench.panel.text.text() == f"swing: {len(run.record.time_s)} rows"
        assert run.gaps["zn", Tap.MEAS].rms < 1e-7
        assert len(bench.panel.moved) > 5  # the panel followed it
        assert bench.play(swing(), "again") is not run
        with pytest.raises(InputError, match="zn"):
            bench.play(swing(1.0))


def test_a_record_is_handed_over_with_its_gap():
    with panel_bench(Listener) as bench:
        run = bench.hand_record(swing(signals=(Tap.CMD, Tap.MEAS)), "tuesday")
        assert bench.workbench.run is run
        assert bench.panel.text.text() == "tuesday: 251 rows"


def test_a_panel_hears_of_a_stop_and_moves_axes_together():
    with panel_bench(Panel) as bench:
        session, stops = bench.workbench.session, []
        bench.workbench.stopped.connect(lambda: stops.append(session.snapshot().stop.why))
        before = session.snapshot().command
        session.stop("enough")
        bench.advance(0.1)
        assert stops == ["enough"]
        assert bench.workbench.penetration == "disarmed"
        session.stop()
        session.move_by({"x": 1e-4, "zn": 1e-6}, owner="test")
        bench.advance(0.02)
        assert session.snapshot().phase is Phase.MOVING  # what rests when it is stopped has stopped
        bench.advance(3.0)
        after = session.snapshot().command
        assert {axis: after[axis] - before[axis] for axis in after} == pytest.approx(
            {"x": 1e-4, "y": 0.0, "z": 0.0, "thx": 0.0, "thy": 0.0, "zn": 1e-6}, abs=1e-12
        )
        with pytest.raises(OutOfLimitsError):
            session.move_by({"x": 1e-4, "zn": 1.0})
        bench.advance(1.0)
        assert session.snapshot().command == after
