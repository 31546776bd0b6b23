"""Nothing that can be pressed moves under the mouse while the machine changes its state."""

from dataclasses import replace
from importlib.metadata import entry_points

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, QRect
from PySide6.QtWidgets import QAbstractButton, QTabBar

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection
from rotemina.app.panel import Area
from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.app.shell.loaded_trajectory import Plan
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap

PANELS = {point.name: point for point in entry_points(group="rotemina.panels")}
FRAME_S = 0.04
MOST = 1  # px
SIZES = {
    Area.LEFT: (296, 640),
    Area.RIGHT: (440, 640),
    Area.BOTTOM: (944, 300),
    Area.CENTRE: (944, 450),
}
TIME_S = np.arange(1501) / 500.0
SWING = Record.from_signals(
    TIME_S, {("zn", Tap.CMD): 30e-6 + 20e-6 * np.sin(np.pi * TIME_S / 3.0) ** 4}, {"zn": "m"}
)

# What a board may report; the bench's machine never does.
REPORTED = {
    "fault": {"fault": "the board reports an error", "activity": DeviceState.FAULT},
    "not homed": {"unhomed": ("x", "y"), "position_known": False},
    "in doubt": {"doubt": "the link was lost", "position_known": False},
    "other parameters": {"differences": ("x: 400 steps per mm, not 800", "y: likewise")},
    "connection failed": {"connection": Connection.FAILED, "activity": DeviceState.CLOSED},
}


class Places:
    """Where the buttons of a panel are, on each of its pages, from state to state."""

    def __init__(self, bench):
        self._bench, self._panel = bench, bench.panel
        self._before, self.moved = {}, []

    def look(self, state):
        """Note what has moved since the state before."""
        self._bench.refresh()
        self._look_at_page(state, "")
        for bar in self._panel.findChildren(QTabBar):
            if bar.isVisibleTo(self._panel):
                kept = bar.currentIndex()
                for index in filter(bar.isTabEnabled, range(bar.count())):
                    bar.setCurrentIndex(index)
                    self._bench.refresh()
                    self._look_at_page(state, bar.tabText(index))
                bar.setCurrentIndex(kept)

    def _look_at_page(self, state, page):
        for _ in range(3):  # scroll areas and labels that wrap lay out what they hold once more
            QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        for button in self._panel.findChildren(QAbstractButton):
            if not button.isVisibleTo(self._panel):
                continue
            place = QRect(button.mapTo(self._panel, QPoint(0, 0)), button.size())
            now = place, state, button.isEnabled()
            before, when, was_enabled = self._before.get((button, page), now)
            apart = np.subtract(place.getCoords(), before.getCoords())
            if np.abs(apart).max() > MOST and (button.isEnabled() or was_enabled):
                name = button.text() or button.accessibleName()
                self.moved.append(f"{page} {name!r} by {apart} from {when} to {state}")
            self._before[button, page] = now


def pass_s(bench, seconds):
    for _ in range(round(seconds / FRAME_S)):
        bench.advance(FRAME_S)


def drive(bench, monkeypatch):
    """Drive the machine through its states; yield the name of each."""
    session, workbench = bench.workbench.session, bench.workbench
    playback = workbench.playback
    yield "ready"
    session.jog("x", 5e-3)
    pass_s(bench, 0.1)
    assert session.snapshot().activity is DeviceState.MOVING
    yield "moving"
    session.stop()
    pass_s(bench, 1.0)
    yield "stopped"
    workbench.take_plan(Plan.tried(session, "swing", SWING))
    yield "loaded"
    workbench.playback.play(workbench.plan.dry_run.require())
    pass_s(bench, 1.2)
    assert playback.state.phase is PlaybackPhase.PLAYING
    yield "playing"
    playback.pause()
    pass_s(bench, 1.0)
    assert playback.state.phase is PlaybackPhase.PAUSED
    yield "paused"
    playback.resume()
    pass_s(bench, 0.4)
    yield "playing again"
    session.emergency_stop()
    pass_s(bench, 1.0)
    yield "locked"
    session.release()
    pass_s(bench, 0.1)
    yield "released"
    for name, change in REPORTED.items():
        state = replace(session.snapshot(), locked="the board reports it", **change)
        with monkeypatch.context() as patch:
            patch.setattr(MotionSession, "snapshot", lambda _, state=state: state)
            yield name
        yield f"after {name}"
    session.disconnect()
    pass_s(bench, 0.1)
    yield "disconnected"


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize("name", PANELS)
def test_no_button_moves_while_the_machine_changes_its_state(name, monkeypatch):
    with panel_bench(PANELS[name].load()) as bench:
        bench.panel.resize(*SIZES[bench.panel.area])
        bench.panel.show()
        places = Places(bench)
        for state in drive(bench, monkeypatch):
            places.look(state)
        assert places.moved == []
