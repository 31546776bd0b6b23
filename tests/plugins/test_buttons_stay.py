"""Buttons keep their positions while the machine changes its state."""

from dataclasses import replace
from importlib.metadata import entry_points

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, QRect
from PySide6.QtWidgets import QAbstractButton, QTabBar

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState
from rotemina.app.panel import PanelArea
from rotemina.app.plugin_kit import open_panel_bench
from rotemina.app.workbench import TrajectoryPlan
from rotemina.drivers.contract import DeviceState
from rotemina.sim.records import Record, Tap

PANELS = {point.name: point for point in entry_points(group="rotemina.panels")}
FRAME_S = 0.04
MAX_SHIFT_PX = 1
SIZES = {
    PanelArea.LEFT: (296, 640),
    PanelArea.RIGHT: (440, 640),
    PanelArea.BOTTOM: (944, 300),
    PanelArea.CENTRE: (944, 450),
}
TIME_S = np.arange(1501) / 500.0
SWING = Record.from_signals(
    TIME_S, {("zn", Tap.CMD): 30e-6 + 20e-6 * np.sin(np.pi * TIME_S / 3.0) ** 4}, {"zn": "m"}
)

# Problems that a board may report. The simulated machine never reports them.
REPORTED_PROBLEMS = {
    "fault": {"fault": "the board reports an error", "activity": DeviceState.FAULT},
    "not homed": {"unhomed": ("x", "y"), "position_known": False},
    "in doubt": {"doubt": "the link was lost", "position_known": False},
    "other parameters": {"differences": ("x: 400 steps per mm, not 800", "y: likewise")},
    "connection failed": {"connection": ConnectionState.FAILED, "activity": DeviceState.CLOSED},
}


class ButtonPositions:
    """Positions of the buttons on all pages of a panel, compared from state to state."""

    def __init__(self, bench):
        self._bench, self._panel = bench, bench.panel
        self._previous, self.moved = {}, []

    def record(self, state):
        """Note the positions, and the buttons that have moved since the previous state."""
        self._bench.refresh()
        self._record_page(state, "")
        for bar in self._panel.findChildren(QTabBar):
            if bar.isVisibleTo(self._panel):
                page_index = bar.currentIndex()
                for index in filter(bar.isTabEnabled, range(bar.count())):
                    bar.setCurrentIndex(index)
                    self._bench.refresh()
                    self._record_page(state, bar.tabText(index))
                bar.setCurrentIndex(page_index)

    def _record_page(self, state, page):
        for _ in range(3):  # scroll areas and wrapping labels need several layout passes
            QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        for button in self._panel.findChildren(QAbstractButton):
            if not button.isVisibleTo(self._panel):
                continue
            rectangle = QRect(button.mapTo(self._panel, QPoint(0, 0)), button.size())
            current = rectangle, state, button.isEnabled()
            previous_place, previous_state, was_enabled = self._previous.get(
                (button, page), current
            )
            shift = np.subtract(rectangle.getCoords(), previous_place.getCoords())
            if np.abs(shift).max() > MAX_SHIFT_PX and (button.isEnabled() or was_enabled):
                name = button.text() or button.accessibleName()
                self.moved.append(f"{page} {name!r} by {shift} from {previous_state} to {state}")
            self._previous[button, page] = current


def advance(bench, seconds):
    for _ in range(round(seconds / FRAME_S)):
        bench.advance(FRAME_S)


def drive_through_states(bench, monkeypatch):
    """Bring the machine into its states, and yield the name of each."""
    session, workbench = bench.workbench.session, bench.workbench
    playback = workbench.playback
    yield "ready"
    session.jog("x", 5e-3)
    advance(bench, 0.1)
    assert session.snapshot().activity is DeviceState.MOVING
    yield "moving"
    session.stop()
    advance(bench, 1.0)
    yield "stopped"
    workbench.take_plan(TrajectoryPlan.from_trajectory(session, "swing", SWING))
    yield "loaded"
    workbench.playback.play(workbench.plan.dry_run.require())
    advance(bench, 1.2)
    assert playback.state.phase is PlaybackPhase.PLAYING
    yield "playing"
    playback.pause()
    advance(bench, 1.0)
    assert playback.state.phase is PlaybackPhase.PAUSED
    yield "paused"
    playback.resume()
    advance(bench, 0.4)
    yield "playing again"
    session.emergency_stop()
    advance(bench, 1.0)
    yield "locked"
    session.release()
    advance(bench, 0.1)
    yield "released"
    for name, change in REPORTED_PROBLEMS.items():
        state = replace(session.snapshot(), lock_reason="the board reports it", **change)
        with monkeypatch.context() as patch:
            patch.setattr(MotionSession, "snapshot", lambda _, state=state: state)
            yield name
        yield f"after {name}"
    session.disconnect()
    advance(bench, 0.1)
    yield "disconnected"


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize("name", PANELS)
def test_buttons_do_not_move_while_the_machine_changes_its_state(name, monkeypatch):
    with open_panel_bench(PANELS[name].load()) as bench:
        bench.panel.resize(*SIZES[bench.panel.area])
        bench.panel.show()
        positions = ButtonPositions(bench)
        for state in drive_through_states(bench, monkeypatch):
            positions.record(state)
        assert positions.moved == []
