"""The panel bench passes a record to a panel and plays a trajectory for it."""

import numpy as np
import pytest
from PySide6.QtWidgets import QLabel

from rotemina.app.motion.state import SessionPhase
from rotemina.app.panel import Panel
from rotemina.app.plugin_kit import open_panel_bench
from rotemina.sim.errors import InputError, OutOfLimitsError
from rotemina.sim.records import Record, Tap

pytestmark = pytest.mark.usefixtures("qapp")


class ListeningPanel(Panel):
    title = "Listener"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.text, self.plans, self.positions_nm = QLabel(), [], set()
        workbench.plan_changed.connect(self.take_plan)
        workbench.run_changed.connect(self.take_run)
        workbench.shown.connect(self.take_state)

    def take_plan(self, plan):
        self.plans.append(plan.name)

    def take_run(self, run):
        self.text.setText(f"{run.name}: {len(run.record.time_s)} rows")

    def take_state(self, state):
        self.positions_nm.add(round(1e9 * state.command["zn"]))


def make_swing(height=5e-6, signals=(Tap.CMD,)):
    time_s = np.arange(251) / 500.0
    position = 3e-5 + height * np.sin(np.pi * time_s / time_s[-1]) ** 4
    return Record.from_signals(time_s, {("zn", tap): position for tap in signals}, {"zn": "m"})


def test_trajectory_is_planned_played_and_compared():
    with open_panel_bench(ListeningPanel) as bench:
        run = bench.play(make_swing(), "swing")
        assert bench.panel.plans == ["swing"]
        assert bench.panel.text.text() == f"swing: {len(run.record.time_s)} rows"
        assert run.gaps["zn", Tap.MEAS].rms < 1e-7
        assert len(bench.panel.positions_nm) > 5  # the panel followed the motion
        assert bench.play(make_swing(), "again") is not run
        with pytest.raises(InputError, match="zn"):
            bench.play(make_swing(1.0))


def test_record_is_passed_with_its_gap():
    with open_panel_bench(ListeningPanel) as bench:
        run = bench.hand_record(make_swing(signals=(Tap.CMD, Tap.MEAS)), "tuesday")
        assert bench.workbench.run is run
        assert bench.panel.text.text() == "tuesday: 251 rows"


def test_panel_is_notified_of_a_stop_and_moves_axes_together():
    with open_panel_bench(Panel) as bench:
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
        # Axes that are already at rest count as stopped at once.
        assert session.snapshot().phase is SessionPhase.MOVING
        bench.advance(3.0)
        after = session.snapshot().command
        assert {axis: after[axis] - before[axis] for axis in after} == pytest.approx(
            {"x": 1e-4, "y": 0.0, "z": 0.0, "thx": 0.0, "thy": 0.0, "zn": 1e-6}, abs=1e-12
        )
        with pytest.raises(OutOfLimitsError):
            session.move_by({"x": 1e-4, "zn": 1.0})
        bench.advance(1.0)
        assert session.snapshot().command == after
