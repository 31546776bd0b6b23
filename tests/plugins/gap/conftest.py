"""A small diagnosis made by hand, of a record whose cause is known, and a window with the page."""

import gc
import threading

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QMainWindow

from rotemina.app.motion.session import MotionSession
from rotemina.app.shell import theme as themes
from rotemina.app.shell.window_run import make_application
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.gap.panel import GapPanel
from rotemina.sim.gap.diagnosis import (
    AxisDiagnosis,
    Cause,
    Diagnosis,
    FittedParameter,
    Ranked,
    Shrinkage,
    ShrinkageStep,
    Untestable,
    Verdict,
)
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.where import locate
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
def diagnosis(record):
    """Hysteresis on θx, or creep; nothing on θy."""

    def places(axis):
        return locate(Evidence.of(ROBOT, axis, [record]), np.random.default_rng(0))

    cause = Cause(
        axis="thx",
        effect="hysteresis",
        formulation="prandtl_ishlinskii",
        stage="actuator",
        tap=Tap.MEAS,
        from_axis=None,
        probability=0.91,
        ambiguous_with=("creep",),
        gap_before=3.2e-5,
        gap_after=7.6e-7,
        closed=0.98,
        closed_interval=(0.97, 0.99),
        parameters=(FittedParameter("width", 1.2e-4, "rad", (1.1e-4, 1.3e-4), "high"),),
    )
    shrinkage = Shrinkage(
        axis="thx",
        tap=Tap.MEAS,
        raw=3.3e-5,
        retuned=3.2e-5,
        corrected=7.7e-7,
        floor=4e-7,
        ceiling=None,
        closed=0.97,
        closed_interval=(0.96, 0.98),
        steps=(ShrinkageStep("hysteresis", "thx", 7.8e-7, 1.0),),
    )
    thx = AxisDiagnosis(
        axis="thx",
        verdict=Verdict.EXPLAINED,
        places=places("thx"),
        causes=(cause,),
        shrinkage=(shrinkage,),
        ranking=(
            Ranked("hysteresis", "prandtl_ishlinskii", None, 0.91, 1.2, (1.1, 1.3)),
            Ranked("cross_coupling", None, "thy", 0.09, 43.0, (38.0, 47.0)),
        ),
        untestable=(Untestable("sensor_gain", "no reference was measured"),),
        fitted=(LOOP,),
    )
    thy = AxisDiagnosis("thy", Verdict.NONE, places("thy"))
    return Diagnosis(ROBOT, {"thx": thx, "thy": thy})


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
