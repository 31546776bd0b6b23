"""Fixtures for all tests: Qt offscreen, windows, recordings, diagnoses, shared material."""

import gc
import os
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import settings

# The same examples on every machine, however slow it is at the moment.
settings.register_profile("repeatable", derandomize=True, deadline=None, print_blob=True)
settings.load_profile("repeatable")

# Without this configuration the offscreen screen has 800 × 800 px, which limits all windows.
SCREEN = Path(__file__).with_name("screen.json")
os.environ.setdefault("QT_QPA_PLATFORM", f"offscreen:configfile={SCREEN}")
# Tests expect English texts, whatever the language of the machine.
os.environ["LANGUAGE"] = "en"

#: Panels that every window in tests has.
USUAL_PANELS = ("control", "trajectory")

DEFAULT_SHARED_FOLDER = Path(__file__).parents[2] / "shared"


def pytest_collection_finish():
    """Exclude permanent objects from garbage collection, which would stop all threads for 0.4 s."""
    gc.collect()
    gc.freeze()


def pytest_terminal_summary(terminalreporter):
    """Report how often a test was repeated because the machine was too busy for its boards."""
    reports = [report for group in terminalreporter.stats.values() for report in group]
    for report in reports:
        if getattr(report, "when", None) == "call":
            tries = [reason for name, reason in report.user_properties if name == "tried again"]
            if tries:
                terminalreporter.write_line(f"tried again {len(tries)} times: {report.nodeid}")


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """Folder of shared material: ``ROTEMINA_SHARED``, or by default ``../shared``."""
    folder = Path(os.environ.get("ROTEMINA_SHARED", DEFAULT_SHARED_FOLDER))
    if folder.is_dir():
        return folder
    problem = f"no shared material in {folder} (set ROTEMINA_SHARED)"
    if os.environ.get("CI") == "true":
        pytest.fail(problem)
    pytest.skip(problem)


@pytest.fixture
def settings(tmp_path):
    """Empty preferences in a temporary folder."""
    from rotemina.app.settings import UserSettings

    return UserSettings(tmp_path / "preferences" / "settings.json")


@pytest.fixture
def panels_made(request, monkeypatch):
    """Limit the panels of a window to those that a test module needs.

    Making all panels takes seconds. ``PANELS`` in a module names those in addition to the usual
    ones. Tests in the folder or file of a panel get that panel. All other tests, and those marked
    ``every_panel``, get all panels.
    """
    wanted_panels = getattr(request.module, "PANELS", None)
    if "plugins" in request.path.parts:
        wanted_panels = {
            *(wanted_panels or ()),
            request.path.parent.name,
            *request.path.stem.split("_"),
        }
    if wanted_panels is None or request.node.get_closest_marker("every_panel") is not None:
        return
    from rotemina.app.shell.panels import panel_host

    discover = panel_host.discover_plugins

    def discover_some(group, base, known):
        discovery = discover(group, base, known)
        wanted_plugins = {
            name: plugin
            for name, plugin in discovery.plugins.items()
            if name in {*USUAL_PANELS, *wanted_panels}
        }
        return replace(discovery, plugins=wanted_plugins)

    monkeypatch.setattr(panel_host, "discover_plugins", discover_some)


@pytest.fixture
def make_robot_window(qtbot, settings, tmp_path, panels_made):
    """Return a function that makes a window on the simulator of a robot.

    All windows are closed after the test, and no thread may remain. If ``driver`` is given, it is
    called with the robot, and the function does not wait until motion is permitted.
    """
    import threading

    from PySide6.QtCore import QCoreApplication, QEvent
    from shiboken6 import isValid

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.shell.startup.window_run import make_window
    from rotemina.drivers.simulator import Simulator
    from rotemina.sim.robot_files import load_robot

    windows = []
    # As in the program: the thread of the session must not free objects of Qt.
    gc.disable()

    def make(robot="rotemina", driver=None):
        robot_model = load_robot(robot)
        simulator = Simulator(robot_model, {"settle_s": 0.02})
        session = MotionSession(driver(robot_model) if driver else simulator)
        window = make_window(session, settings, tmp_path / "played")
        windows.append(window)
        window.show()
        window.workbench.start()
        if driver is None:
            qtbot.waitUntil(lambda: session.snapshot().lock_reason is None, timeout=20_000)
        return window

    yield make
    # A test may already have closed and deleted a window.
    for window in filter(isValid, windows):
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
    """A main window on the simulated RoTeMiNa, connected and idle."""
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
    """Return a function that opens the first menu of a window by a click, and returns the menu."""
    from PySide6.QtCore import Qt
    from PySide6.QtTest import QTest

    def open_first(window):
        bar = window.menuBar()
        position = bar.mapTo(window, bar.actionGeometry(bar.actions()[0]).center())
        for act in (QTest.mousePress, QTest.mouseRelease):
            act(window.windowHandle(), Qt.MouseButton.LeftButton, pos=position)
        menu = bar.actions()[0].menu()
        assert menu.isVisible()
        return menu

    return open_first


@pytest.fixture
def press_behind_menu():
    """Return a function that presses the mouse on a button behind an open menu."""
    from PySide6.QtCore import QEvent, QPointF, Qt
    from PySide6.QtGui import QMouseEvent
    from PySide6.QtWidgets import QApplication

    def press(menu, button):
        position, left = button.mapToGlobal(button.rect().center()), Qt.MouseButton.LeftButton
        event = QMouseEvent(
            QEvent.Type.MouseButtonPress,
            QPointF(menu.mapFromGlobal(position)),
            QPointF(position),
            left,
            left,
            Qt.KeyboardModifier.NoModifier,
        )
        QApplication.sendEvent(menu.windowHandle(), event)

    return press


@pytest.fixture
def make_recording():
    """Return a function that records 1.2 s: x moves from 0.2 s on, a note is added at 1 s."""
    from rotemina.app.motion.recording import SessionRecorder
    from rotemina.app.motion.session import MotionSession
    from rotemina.drivers.contract import VirtualClock
    from rotemina.drivers.simulator import Simulator
    from rotemina.sim.robot_files import load_robot

    unfinished_files = []

    def record_session(path, robot="rotemina", *, ended=True):
        path.parent.mkdir(parents=True, exist_ok=True)
        clock = VirtualClock(7.0)
        session = MotionSession(Simulator(load_robot(robot), clock=clock))
        session.connect()
        session.run_once()
        start_date = "2026-03-04T05:06:07+01:00"
        recorder = SessionRecorder(session, path, began=start_date, clock=clock)
        recorder.start(thread=False)
        axis = session.driver.axes[0]
        for step in range(60):
            if step == 10:
                session.jog(axis, 5e-4 if robot == "rotemina" else 1e-6)
            if step == 50:
                recorder.record_note("a note")
            clock.advance(0.02)
            session.run_once()
        recorder.writer.run_once()
        if ended:
            recorder.close()
        else:
            unfinished_files.append(recorder.writer._file)
        session.close()
        return path

    yield record_session
    for file in unfinished_files:
        file.close()


@pytest.fixture(scope="session")
def make_diagnosis():
    """Return a function that makes a diagnosis: hysteresis or creep on thx, other axes healthy."""
    import numpy as np

    from rotemina.sim.effects import EffectStage
    from rotemina.sim.gap.result import diagnosis as gap
    from rotemina.sim.messages import message
    from rotemina.sim.records import Tap
    from rotemina.sim.robot import AxisEffect
    from rotemina.sim.robot_files import load_robot

    width = gap.FittedParameter("width", 1.2e-4, "rad", (1.1e-4, 1.3e-4), "high")
    shape = gap.FittedParameter("shape", 4.0, "", None)
    hysteresis = gap.GapCause(
        axis="thx",
        effect="hysteresis",
        formulation="prandtl_ishlinskii",
        stage=EffectStage.ACTUATOR,
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
    shrinkage = gap.GapShrinkage(
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
    experiment = gap.SuggestedExperiment(
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
        """Return a diagnosis of thx and ``others``; ``places`` gives the gaps of each axis."""
        thx = gap.AxisDiagnosis(
            axis="thx",
            verdict=gap.GapVerdict.EXPLAINED,
            places=places("thx"),
            causes=(hysteresis,),
            shrinkage=(shrinkage,),
            ranking=(
                gap.RankedCandidate(
                    "hysteresis", "prandtl_ishlinskii", None, 0.91, 1.2, (1.1, 1.3)
                ),
                gap.RankedCandidate("cross_coupling", None, others[0], 0.09, 43.0, (38.0, 47.0)),
            ),
            remarks=(message("gap", "The rest depends on time."),),
            fitted=(AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.2e-4}),),
        )
        healthy_axes = {
            name: gap.AxisDiagnosis(name, gap.GapVerdict.NONE, places(name)) for name in others
        }
        robot = load_robot("rotemina")
        return gap.Diagnosis(robot, {"thx": thx, **healthy_axes}, experiments=(experiment,), seed=3)

    return make


@pytest.fixture
def made_diagnosis(make_diagnosis):
    """An invented diagnosis: hysteresis and more on thx, an unknown cause on y, no gap on zn."""
    from rotemina.sim.effects import EffectStage
    from rotemina.sim.gap.location import GapPortion, LocatedGap, OperatingRegime
    from rotemina.sim.gap.result import UNKNOWN_EFFECT_ID, GapVerdict
    from rotemina.sim.records import Tap
    from rotemina.sim.robot import AxisEffect

    def places(axis):
        """Return two gaps of thx, or one of any other axis."""
        gaps = {
            "thx": (
                (Tap.REF, EffectStage.ACTUATOR, 1.0e-7, 200.0, 20.0),
                (Tap.MEAS, EffectStage.SENSOR, 4.0e-7, 100.0, 10.0),
            ),
            "y": ((Tap.MEAS, EffectStage.ACTUATOR, 2.0e-8, 15.0, 5.0),),
            "zn": ((Tap.MEAS, EffectStage.ACTUATOR, 1.2e-8, 0.01, 0.05),),
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
                    OperatingRegime.REVERSAL: GapPortion(0.8, (0.7, 0.9), 2.0 * excess),
                    OperatingRegime.REST: GapPortion(0.2, (0.1, 0.3), 0.5 * excess),
                },
                by_band={
                    (0.5, 4.0): GapPortion(0.9, (0.8, 1.0)),
                    (4.0, 10.0): GapPortion(0.1, (0.0, 0.2)),
                },
            )
            for tap, stage, floor, excess, spread in gaps[axis]
        )

    diagnosis = make_diagnosis(places, "y", "zn")
    thx, y = diagnosis.axes["thx"], diagnosis.axes["y"]
    unknown_cause = replace(
        thx.causes[0],
        axis="y",
        effect=UNKNOWN_EFFECT_ID,
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
        "y": replace(y, verdict=GapVerdict.UNKNOWN, causes=(unknown_cause,)),
        "thx": replace(thx, fitted=fitted),
        "zn": diagnosis.axes["zn"],
    }
    return replace(diagnosis, axes=axes)
