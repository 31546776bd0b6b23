"""What every test may use: an offscreen Qt and the folder of shared material."""

import gc
import os
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import settings

# The same examples on every machine, however slow it is at the moment.
settings.register_profile("repeatable", derandomize=True, deadline=None, print_blob=True)
settings.load_profile("repeatable")

# Without a configuration the screen has 800 × 800 px, beyond which no window goes.
SCREEN = Path(__file__).with_name("screen.json")
os.environ.setdefault("QT_QPA_PLATFORM", f"offscreen:configfile={SCREEN}")
os.environ["LANGUAGE"] = "en"  # tests know the window in English, whatever the machine speaks

#: Panels of every window in tests, whatever others they ask for.
USUAL = ("control", "trajectory")

BESIDE_REPOSITORY = Path(__file__).parents[2] / "shared"


def pytest_collection_finish():
    """Spare the garbage collector what stays anyway: 0.4 s for which every thread waits."""
    gc.collect()
    gc.freeze()


def pytest_terminal_summary(terminalreporter):
    """Tell how often a test was tried again because this machine was too busy for its boards."""
    reports = [one for each in terminalreporter.stats.values() for one in each]
    for one in reports:
        if getattr(one, "when", None) == "call":
            tries = [why for name, why in one.user_properties if name == "tried again"]
            if tries:
                terminalreporter.write_line(f"tried again {len(tries)} times: {one.nodeid}")


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """Folder of shared material: ``ROTEMINA_SHARED``, else ``../shared``."""
    folder = Path(os.environ.get("ROTEMINA_SHARED", BESIDE_REPOSITORY))
    if folder.is_dir():
        return folder
    absent = f"no shared material in {folder} (set ROTEMINA_SHARED)"
    if os.environ.get("CI") == "true":
        pytest.fail(absent)
    pytest.skip(absent)


@pytest.fixture
def settings(tmp_path):
    """Preferences of nobody, kept in the test's own folder."""
    from rotemina.app.settings import Settings

    return Settings(tmp_path / "preferences" / "settings.json")


@pytest.fixture
def panels_made(request, monkeypatch):
    """Leave out of a window the panels that a module of tests does not ask for.

    Making all of them takes seconds. ``PANELS`` in a module names those beside the usual ones;
    tests of one panel ask for that one by their place; others, and those that are marked
    ``every_panel``, get all.
    """
    wanted = getattr(request.module, "PANELS", None)
    if "plugins" in request.path.parts:
        wanted = {*(wanted or ()), request.path.parent.name, *request.path.stem.split("_")}
    if wanted is None or request.node.get_closest_marker("every_panel") is not None:
        return
    from rotemina.app.shell import panel_host

    discover = panel_host.discover

    def some(group, base, known):
        found = discover(group, base, known)
        kept = {name: one for name, one in found.found.items() if name in {*USUAL, *wanted}}
        return replace(found, found=kept)

    monkeypatch.setattr(panel_host, "discover", some)


@pytest.fixture
def make_robot_window(qtbot, settings, tmp_path, panels_made):
    """Make windows on the simulator of any robot; all are closed, and no thread stays.

    With a driver of its own, made of the robot, nobody waits until the window can move anything.
    """
    import threading

    from PySide6.QtCore import QCoreApplication, QEvent
    from shiboken6 import isValid

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.shell.window_run import make_window
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.robot.file import load_robot

    windows = []
    gc.disable()  # as the program does: the session's thread must not free what is Qt's

    def make(robot="rotemina", driver=None):
        described = load_robot(robot)
        simulator = Simulator(described, {"settle_s": 0.02})
        session = MotionSession(driver(described) if driver else simulator)
        window = make_window(session, settings, tmp_path / "played")
        windows.append(window)
        window.show()
        window.workbench.start()
        if driver is None:
            qtbot.waitUntil(lambda: session.snapshot().locked is None, timeout=20_000)
        return window

    yield make
    for window in filter(isValid, windows):  # a test may have closed its own
        window.workbench.close()
        window.hide()
        window.deleteLater()
    windows.clear()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    gc.enable()
    assert not [thread for thread in threading.enumerate() if thread.name == "motion session"]


@pytest.fixture
def window(make_robot_window):
    """The operator's window on the simulated RoTeMiNa, connected and idle."""
    return make_robot_window()


@pytest.fixture
def press_escape(qtbot):
    """Return a function that presses Esc in the window of a widget, as the desktop does.

    The desktop sends keys to the window that has the focus.
    """
    from PySide6.QtCore import Qt
    from PySide6.QtGui import QGuiApplication
    from PySide6.QtTest import QTest

    def press(widget, modifiers=Qt.KeyboardModifier.NoModifier):
        window = widget.window()
        window.activateWindow()
        qtbot.waitUntil(lambda: QGuiApplication.focusWindow() is window.windowHandle())
        widget.setFocus()
        QTest.keyClick(window.windowHandle(), Qt.Key.Key_Escape, modifiers)

    return press


@pytest.fixture
def open_menu():
    """Return a function that clicks on the first menu of a window, and returns the menu."""
    from PySide6.QtCore import Qt
    from PySide6.QtTest import QTest

    def open_first(window):
        bar = window.menuBar()
        place = bar.mapTo(window, bar.actionGeometry(bar.actions()[0]).center())
        for act in (QTest.mousePress, QTest.mouseRelease):
            act(window.windowHandle(), Qt.MouseButton.LeftButton, pos=place)
        menu = bar.actions()[0].menu()
        assert menu.isVisible()
        return menu

    return open_first


@pytest.fixture
def press_behind_menu():
    """Return a function that presses the mouse on a button while a menu takes all presses."""
    from PySide6.QtCore import QEvent, QPointF, Qt
    from PySide6.QtGui import QMouseEvent
    from PySide6.QtWidgets import QApplication

    def press(menu, button):
        place, left = button.mapToGlobal(button.rect().center()), Qt.MouseButton.LeftButton
        event = QMouseEvent(
            QEvent.Type.MouseButtonPress,
            QPointF(menu.mapFromGlobal(place)),
            QPointF(place),
            left,
            left,
            Qt.KeyboardModifier.NoModifier,
        )
        QApplication.sendEvent(menu.windowHandle(), event)

    return press


@pytest.fixture
def make_recording():
    """Record a session of 1.2 s: x moves from 0.2 s on, at 1 s somebody notes something."""
    from rotemina.app.motion.recording.session_recorder import SessionRecorder
    from rotemina.app.motion.session import MotionSession
    from rotemina.drivers.clock import VirtualClock
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.robot.file import load_robot

    left = []

    def make(path, robot="rotemina", *, ended=True):
        path.parent.mkdir(parents=True, exist_ok=True)
        clock = VirtualClock(7.0)
        session = MotionSession(Simulator(load_robot(robot), clock=clock))
        session.connect()
        session.run_once()
        began = "2026-03-04T05:06:07+01:00"
        recorder = SessionRecorder(session, path, began=began, clock=clock)
        recorder.start(thread=False)
        axis = session.driver.axes[0]
        for step in range(60):
            if step == 10:
                session.jog(axis, 5e-4 if robot == "rotemina" else 1e-6)
            if step == 50:
                recorder.note("a note")
            clock.advance(0.02)
            session.run_once()
        recorder.writer.run_once()
        if ended:
            recorder.close()
        else:
            left.append(recorder.writer._file)
        session.close()
        return path

    yield make
    for file in left:
        file.close()


@pytest.fixture(scope="session")
def make_diagnosis():
    """A maker of a diagnosis by hand: hysteresis on thx, or creep; nothing on the other axes."""
    import numpy as np

    from rotemina.sim.effects.formulation import Stage
    from rotemina.sim.gap import diagnosis as gap
    from rotemina.sim.messages import message
    from rotemina.sim.records.record import Tap
    from rotemina.sim.robot.file import load_robot
    from rotemina.sim.robot.model import AxisEffect

    width = gap.FittedParameter("width", 1.2e-4, "rad", (1.1e-4, 1.3e-4), "high")
    shape = gap.FittedParameter("shape", 4.0, "", None)
    loop = gap.Cause(
        axis="thx",
        effect="hysteresis",
        formulation="prandtl_ishlinskii",
        stage=Stage.ACTUATOR,
        tap=Tap.MEAS,
        from_axis=None,
        probability=0.91,
        ambiguous_with=("creep",),
        gap_before=3.2e-5,
        gap_after=7.6e-7,
        closed=0.98,
        closed_interval=(0.97, 0.99),
        parameters=(width, shape),
    )
    shrinkage = gap.Shrinkage(
        axis="thx",
        tap=Tap.MEAS,
        raw=3.3e-5,
        retuned=3.2e-5,
        corrected=7.7e-7,
        floor=4e-7,
        ceiling=None,
        closed=0.97,
        closed_interval=(0.96, 0.98),
        steps=(gap.ShrinkageStep("hysteresis", "thx", 7.8e-7, 0.96),),
    )
    time_s = np.arange(500) / 1000.0
    command = 5.8e-4 + 1e-4 * np.sin(2.0 * np.pi * 2.0 * time_s) ** 2
    split = gap.Experiment(
        axis="thx",
        splits=("hysteresis", "creep"),
        why=message("gap", "A step and a long rest: creep goes on, hysteresis does not."),
        time_s=tuple(time_s.tolist()),
        commands={"thx": tuple(command.tolist())},
        predictions={
            "hysteresis": tuple((0.95 * command).tolist()),
            "creep": tuple((0.97 * command).tolist()),
        },
    )

    def make(places, *others):
        """Return a diagnosis of thx and others, with what ``places`` says of each axis."""
        thx = gap.AxisDiagnosis(
            axis="thx",
            verdict=gap.Verdict.EXPLAINED,
            places=places("thx"),
            causes=(loop,),
            shrinkage=(shrinkage,),
            ranking=(
                gap.Ranked("hysteresis", "prandtl_ishlinskii", None, 0.91, 1.2, (1.1, 1.3)),
                gap.Ranked("cross_coupling", None, others[0], 0.09, 43.0, (38.0, 47.0)),
            ),
            remarks=(message("gap", "The rest depends on time."),),
            fitted=(AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.2e-4}),),
        )
        healthy = {name: gap.AxisDiagnosis(name, gap.Verdict.NONE, places(name)) for name in others}
        robot = load_robot("rotemina")
        return gap.Diagnosis(robot, {"thx": thx, **healthy}, experiments=(split,), seed=3)

    return make


@pytest.fixture
def made_diagnosis(make_diagnosis):
    """Of no record: hysteresis and more on thx, something unknown on y, nothing on zn."""
    from rotemina.sim.effects.formulation import Stage
    from rotemina.sim.gap.diagnosis import UNKNOWN, Verdict
    from rotemina.sim.gap.location.located_gap import LocatedGap, Portion
    from rotemina.sim.gap.location.regimes import Regime
    from rotemina.sim.records.record import Tap
    from rotemina.sim.robot.model import AxisEffect

    def places(axis):
        """Return two places of thx, and one of any other axis."""
        found = {
            "thx": (
                (Tap.REF, Stage.ACTUATOR, 1.0e-7, 200.0, 20.0),
                (Tap.MEAS, Stage.SENSOR, 4.0e-7, 100.0, 10.0),
            ),
            "y": ((Tap.MEAS, Stage.ACTUATOR, 2.0e-8, 15.0, 5.0),),
            "zn": ((Tap.MEAS, Stage.ACTUATOR, 1.2e-8, 0.01, 0.05),),
        }
        return tuple(
            LocatedGap(
                axis=axis,
                tap=tap,
                stage=stage,
                gap_rms=floor * (1.0 + excess) ** 0.5,
                noise_floor=floor,
                excess=excess,
                excess_interval=(excess - spread, excess + spread),
                by_regime={
                    Regime.REVERSAL: Portion(0.8, (0.7, 0.9), 2.0 * excess),
                    Regime.REST: Portion(0.2, (0.1, 0.3), 0.5 * excess),
                },
                by_band={
                    (0.5, 4.0): Portion(0.9, (0.8, 1.0)),
                    (4.0, 10.0): Portion(0.1, (0.0, 0.2)),
                },
            )
            for tap, stage, floor, excess, spread in found[axis]
        )

    made = make_diagnosis(places, "y", "zn")
    thx, y = made.axes["thx"], made.axes["y"]
    strange = replace(
        thx.causes[0],
        axis="y",
        effect=UNKNOWN,
        formulation=None,
        stage=None,
        probability=0.9,
        ambiguous_with=(),
        gap_before=8.0e-8,
        gap_after=float("nan"),
        closed=None,
        closed_interval=None,
        parameters=(),
    )
    fitted = (
        AxisEffect(axis="thx", id="gain_error", parameters={"error": 0.012345678901234567}),
        AxisEffect(
            axis="thx",
            id="hysteresis",
            formulation="prandtl_ishlinskii",
            parameters={"width": 1.1e-4, "shape": 4.0},
        ),
        AxisEffect(
            axis="thx",
            id="cross_coupling",
            formulation="static",
            from_axis="zn",
            parameters={"k": 0.1 + 0.2},
        ),
    )
    axes = {
        "y": replace(y, verdict=Verdict.UNKNOWN, causes=(strange,)),
        "thx": replace(thx, fitted=fitted),
        "zn": made.axes["zn"],
    }
    return replace(made, axes=axes)
