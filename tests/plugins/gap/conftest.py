"""A small diagnosis made by hand, of a record whose cause is known, and a window with the page."""

import gc
import threading
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QMainWindow

from rotemina.app.motion.session import MotionSession
from rotemina.app.shell import theme as themes
from rotemina.app.shell.application import make_application
from rotemina.app.shell.workbench import Run, Workbench
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.panel import GapPanel
from rotemina.sim.comparison.comparison import compare
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.location.located_gap import locate
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
LOOP = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.2e-4})


@pytest.fixture(scope="session")
def record():
    """θx under hysteresis, for two seconds; θy does as it is told."""
    time_s = np.arange(1000) / 500.0
    signals = {}
    for axis, rate_hz in (("thx", 1.0), ("thy", 0.5)):
        own = ROBOT.axes[axis]
        wave = np.sin(2 * np.pi * rate_hz * time_s) * np.linspace(0.05, 0.3, 1000)
        signals[axis, Tap.CMD] = sum(own.range) / 2 + own.span * wave
    asked = Record.from_signals(time_s, signals, {"thx": "rad", "thy": "rad"})
    return simulate(ROBOT, [LOOP], asked, np.random.default_rng(4))


@pytest.fixture(scope="session")
def diagnosis(make_diagnosis, record):
    """Hysteresis on θx, or creep; nothing on θy."""

    def places(axis):
        return locate(Evidence.of(ROBOT, axis, [record]), np.random.default_rng(0))

    return replace(make_diagnosis(places, "thy"), experiments=())


class Host(QMainWindow):
    """A window of nothing but the page: the other panels take their time to be made."""

    def __init__(self, workbench):
        super().__init__()
        self.workbench = workbench
        workbench.setParent(self)
        self.told = []  # the latest last
        self.brought_up = []
        workbench.noticed.connect(lambda _, text: self.told.append(text))
        self.panel = GapPanel(workbench)
        self.setCentralWidget(self.panel)
        self.resize(945, 300)

    def bring_up(self, name):
        self.brought_up.append(name)

    def use_theme(self, name):
        self.workbench.set_theme(themes.theme_named(name))


@pytest.fixture
def window(qtbot, settings, tmp_path):
    """A window with the page on the simulated RoTeMiNa, connected and idle."""
    gc.disable()  # as the program does: the session's thread must not free what is Qt's
    make_application()
    session = MotionSession(Simulator(ROBOT, {"settle_s": 0.02}))
    host = Host(Workbench(session, settings, themes.DARK, tmp_path / "played"))
    host.show()
    host.workbench.start()
    qtbot.waitUntil(lambda: session.snapshot().locked is None, timeout=20_000)
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
def chosen(panel, record):
    """The panel with a record."""
    panel.records.take(Run("day one.csv", compare(panel.workbench.robot, record)))
    return panel


@pytest.fixture
def answered(chosen, diagnosis, record):
    """The panel with an answer."""
    chosen.take_answer(Answer.of(diagnosis, ["day one.csv"], [record]))
    return chosen
