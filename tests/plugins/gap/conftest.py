"""A synthetic diagnosis of a record with a known cause, and a window with the gap panel."""

import gc
import threading
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QMainWindow

from rotemina.app.motion.session import MotionSession
from rotemina.app.shell.startup.application import make_application
from rotemina.app.widgets.style import theme as themes
from rotemina.app.workbench import ComparedRun, Workbench
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.gap.answer import DiagnosisAnswer
from rotemina.plugins.gap.panel import GapPanel
from rotemina.sim.comparison import compare
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.location import locate_gap
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.2e-4})


@pytest.fixture(scope="session")
def record():
    """Return a record of two seconds: θx has hysteresis, θy follows its command."""
    time_s = np.arange(1000) / 500.0
    signals = {}
    for axis, rate_hz in (("thx", 1.0), ("thy", 0.5)):
        description = ROBOT.axes[axis]
        wave = np.sin(2 * np.pi * rate_hz * time_s) * np.linspace(0.05, 0.3, 1000)
        signals[axis, Tap.CMD] = sum(description.range) / 2 + description.span * wave
    commands = Record.from_signals(time_s, signals, {"thx": "rad", "thy": "rad"})
    return simulate(ROBOT, [HYSTERESIS], commands, np.random.default_rng(4))


@pytest.fixture(scope="session")
def diagnosis(make_diagnosis, record):
    """Return a diagnosis: hysteresis or creep on θx, no gap on θy."""

    def locate_axis_gap(axis):
        return locate_gap(Evidence.of(ROBOT, axis, [record]), np.random.default_rng(0))

    return replace(make_diagnosis(locate_axis_gap, "thy"), experiments=())


class GapPanelWindow(QMainWindow):
    """A window with only the gap panel, because the full window takes long to create."""

    def __init__(self, workbench):
        super().__init__()
        self.workbench = workbench
        workbench.setParent(self)
        # Texts of the notices, newest last.
        self.notices = []
        self.brought_up = []
        workbench.notice_posted.connect(lambda _, text: self.notices.append(text))
        self.panel = GapPanel(workbench)
        self.setCentralWidget(self.panel)
        self.resize(945, 300)

    def bring_up(self, name):
        self.brought_up.append(name)

    def use_theme(self, name):
        self.workbench.set_theme(themes.find_theme(name))


@pytest.fixture
def window(qtbot, settings, tmp_path):
    """Yield a window with the panel on the simulated RoTeMiNa, connected and idle."""
    # As in the program: the session thread must not free Qt objects.
    gc.disable()
    make_application()
    session = MotionSession(Simulator(ROBOT, {"settle_s": 0.02}))
    host = GapPanelWindow(Workbench(session, settings, themes.DARK, tmp_path / "played"))
    host.show()
    host.workbench.start()
    qtbot.waitUntil(lambda: session.snapshot().lock_reason is None, timeout=20_000)
    yield host
    host.workbench.close()
    host.hide()
    host.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.enable()
    assert not [thread for thread in threading.enumerate() if thread.name == "motion session"]


@pytest.fixture
def panel(window):
    return window.panel


@pytest.fixture
def panel_with_record(panel, record):
    """Return the panel with one chosen record."""
    panel.records.tick_run(ComparedRun("day one.csv", compare(panel.workbench.robot, record)))
    return panel


@pytest.fixture
def panel_with_answer(panel_with_record, diagnosis, record):
    """Return the panel with an answer to its record."""
    panel_with_record.take_answer(
        DiagnosisAnswer.from_diagnosis(diagnosis, ["day one.csv"], [record])
    )
    return panel_with_record
