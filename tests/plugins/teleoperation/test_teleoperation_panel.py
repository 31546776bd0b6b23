"""The teleoperation panel in the real window, on the simulator and the threads of both."""

import gc
from itertools import cycle

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QWidget

from rotemina.app.motion import operation as operation_module
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.scales import LawKind, Scales
from rotemina.app.shell import theme as themes
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.drivers.inputs.pad import Pad
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.teleoperation.panel import TeleoperationPanel
from rotemina.sim.robot.file import load_robot

PANELS = {"connection"}  # that is brought to the front

LONG_MS = 30_000
LEFT, RIGHT, UP = Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up


@pytest.fixture
def stick():
    """A joystick that a test moves."""
    made = Pad("stick", buttons=(Action.FINE,))
    made.identity = InputIdentity("test:stick", "Bench <stick>", "test")
    made.withdraw()
    return made


@pytest.fixture(autouse=True)
def only_these_devices(monkeypatch, stick):
    """What is plugged into the machine that tests must move nothing."""
    hub = operation_module.InputHub

    def installed(own, *, clock):
        return hub({**own, "test": stick})

    monkeypatch.setattr(hub, "installed", installed)
    monkeypatch.setattr(operation_module, "LOOK_S", 0.05)
    monkeypatch.setattr(operation_module, "PAD_LEASE_S", 30.0)  # a busy machine is no hang


@pytest.fixture
def make_panel(qtbot, settings, tmp_path):
    """Make panels by themselves: a whole window takes a second each."""
    opened = []
    gc.disable()  # as the program does: the session's thread must not free what is Qt's

    def make(robot="rotemina"):
        session = MotionSession(Simulator(load_robot(robot), {"settle_s": 0.02}))
        bench = Workbench(session, settings, themes.DARK, tmp_path / "played")
        found = TeleoperationPanel(bench)
        themes.dress(found, themes.DARK)
        opened.append(found)
        found.resize(330, 1400)
        found.show()
        bench.start()
        qtbot.waitUntil(lambda: found.head.word.text() == "input ready", timeout=LONG_MS)
        return found

    yield make
    for found in opened:
        found.workbench.close()
        found.hide()
        found.deleteLater()
        found.workbench.deleteLater()
    opened.clear()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    gc.enable()


@pytest.fixture
def panel(qtbot, make_panel):
    """The panel, its pad ready and with the focus."""
    found = make_panel()
    focus(qtbot, found)
    return found


@pytest.fixture
def bench(panel):
    return panel.workbench


@pytest.fixture
def notices(bench):
    texts = []
    bench.noticed.connect(lambda _, text: texts.append(text))
    return texts


def focus(qtbot, panel):
    panel.window().activateWindow()
    panel.pad.area.setFocus()
    qtbot.waitUntil(panel.pad.area.hasFocus, timeout=LONG_MS)
    qtbot.waitUntil(lambda: not panel.pad.area.visibleRegion().isEmpty(), timeout=LONG_MS)


def steered(panel):
    return panel.workbench.operation.teleoperator.state


def heeded(panel):
    """Whether every stick was seen at rest: what is held before that does not count."""
    views = steered(panel).coordinates
    return bool(views) and not any(view.waiting or view.deflection is None for view in views)


def driving(qtbot, panel, state=True):
    qtbot.waitUntil(lambda: steered(panel).driving is state, timeout=LONG_MS)


def write(edit, text):
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)


def test_a_key_moves_its_axis_until_it_is_let_go_of(qtbot, bench, panel, notices):
    start = bench.session.snapshot().command
    assert panel.head.device.text() == "On-screen pad"
    qtbot.waitUntil(lambda: panel.head.trust.text() == "Active", timeout=LONG_MS)
    QTest.keyPress(panel.pad.area, RIGHT)
    driving(qtbot, panel)
    qtbot.waitUntil(lambda: panel.head.word.text() == "in control", timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.coordinates.rows["x"].bar.value == 1.0, timeout=LONG_MS)
    assert bench.session.snapshot().owners == {"x": "joystick"}
    for kind in (QEvent.Type.KeyRelease, QEvent.Type.KeyPress):  # what the keyboard repeats
        panel.pad.area.event(QKeyEvent(kind, RIGHT, Qt.KeyboardModifier.NoModifier, "", True))
    assert bench.operation.pad._deflections["x"] == 1.0
    qtbot.waitUntil(lambda: bench.session.snapshot().command["x"] > start["x"], timeout=LONG_MS)
    QTest.keyRelease(panel.pad.area, RIGHT)
    driving(qtbot, panel, False)
    now = bench.session.snapshot().command
    assert now["x"] > start["x"]
    assert now["y"] == start["y"]
    assert notices == []


def test_whatever_takes_the_pad_away_ends_the_motion(qtbot, window):
    panel = window.panels["teleoperation"]
    other = QWidget()
    qtbot.addWidget(other)
    dock, edit = window.docks["teleoperation"], panel.editor.fields["way"]

    def leave_the_window():
        other.show()
        other.activateWindow()

    def scroll_it_away():
        window.docks["connection"].raise_()

    ways = {
        "another field": edit.setFocus,
        "another window": leave_the_window,
        "another dock in front": scroll_it_away,
        "its dock closed": dock.hide,
        "alt": lambda: QTest.keyPress(panel.pad.area, Qt.Key.Key_Alt),
        "shift": lambda: QTest.keyPress(panel.pad.area, Qt.Key.Key_Shift),
        "stop": window.workbench.stop,
        "a profile that is made": window.workbench.operation.devices.open_mapping,
    }
    pad = window.workbench.operation.pad
    # To and fro: at the end of its range the axis would stand, whatever is held.
    for (name, take_away), key in zip(ways.items(), cycle((RIGHT, LEFT)), strict=False):
        dock.show()
        dock.raise_()
        qtbot.waitUntil(lambda: panel.head.word.text() == "input ready", timeout=LONG_MS)
        focus(qtbot, panel)
        qtbot.waitUntil(lambda: heeded(panel), timeout=LONG_MS)
        QTest.keyPress(panel.pad.area, key)
        driving(qtbot, panel)
        take_away()
        driving(qtbot, panel, False)
        if name != "stop":  # there the stick must be let go of before it counts again
            qtbot.waitUntil(lambda: not any(pad._deflections.values()), timeout=LONG_MS)
        else:
            # A window that was busy for longer than the pad's lease has let go of it by itself.
            qtbot.waitUntil(
                lambda: panel.head.word.text() == "waiting" or not any(pad._deflections.values()),
                timeout=LONG_MS,
            )
            QTest.qWait(50)
            assert not steered(panel).driving
        panel.pad.area.release()
        assert not any(pad._held.values()), name
    qtbot.waitUntil(lambda: panel.head.word.text() == "setting up", timeout=LONG_MS)
    assert "being set up" in panel.pad.area.toolTip()


def test_typing_moves_nothing_and_what_is_refused_is_put_back(qtbot, bench, panel, notices):
    start = bench.session.snapshot().command
    editor, steering = panel.editor, bench.operation.teleoperator
    assert [editor.choice.itemText(n) for n in range(editor.choice.count())] == ["X", "Y", "Z"]
    assert not editor.presets.isEnabled()
    write(editor.fields["speed"], "0.25")
    qtbot.waitUntil(lambda: steering.scales.modes != {}, timeout=LONG_MS)
    qtbot.waitUntil(lambda: steered(panel).coordinates != (), timeout=LONG_MS)
    law = panel.coordinates.rows["x"].law
    qtbot.waitUntil(lambda: law.text() == "full deflection = 250 µm/s", timeout=LONG_MS)
    kept = Scales.load(bench.settings.folder / "scales.toml")
    assert kept.modes["micro"]["x"].speed == pytest.approx(2.5e-4)
    write(editor.fields["damping_ratio"], "0.05")
    assert "Damping ratio of x: 0.05: must be at least 0.1" in notices[-1]
    assert editor.fields["damping_ratio"].text() == "1"
    write(editor.fields["way"], "0,5")
    assert "decimal point" in notices[-1]
    assert editor.fields["way"].text() == "0.5"
    qtbot.waitUntil(editor.presets.isEnabled, timeout=LONG_MS)
    editor.presets.click()
    qtbot.waitUntil(lambda: editor.fields["speed"].text() == "1", timeout=LONG_MS)
    for edit in panel.findChildren(QLineEdit):
        QTest.keyClick(edit, RIGHT)
        QTest.keyClick(edit, UP)
    assert bench.session.snapshot().command == start
    assert not steered(panel).driving


def test_modes_and_laws_are_chosen_and_the_screen_follows(qtbot, bench, panel):
    choices, rows = panel.choices, panel.coordinates
    assert list(choices.modes.buttons) == ["micro", "nano", "hybrid", "fine", "pivot"]
    choices.modes.buttons["nano"].click()
    choices.laws.buttons[LawKind.IMPEDANCE].click()
    choices.preset.setCurrentIndex(choices.preset.findData(0.5))
    choices.preset.activated.emit(choices.preset.currentIndex())
    qtbot.waitUntil(lambda: list(rows.rows) == ["thx", "thy", "zn"], timeout=LONG_MS)
    qtbot.waitUntil(lambda: choices.factor.text() == "now × 0.5", timeout=LONG_MS)
    assert choices.modes.buttons["nano"].isChecked()
    assert not rows.rows["zn"].felt.isHidden()
    assert "time constant" in rows.rows["zn"].law.text()
    assert panel.editor.choice.itemText(2) == "Z nano"
    focus(qtbot, panel)
    QTest.keyPress(panel.pad.area, Qt.Key.Key_Control)
    qtbot.waitUntil(lambda: choices.factor.text() == "now × 0.05 (fine)", timeout=LONG_MS)
    QTest.keyRelease(panel.pad.area, Qt.Key.Key_Control, Qt.KeyboardModifier.ControlModifier)
    choices.modes.buttons["fine"].click()
    qtbot.waitUntil(lambda: "arcsec" in panel.reserve.tilt.text(), timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.reserve.bar.value() > 90, timeout=LONG_MS)


def test_the_pointer_drags_and_springs_back(qtbot, bench, panel):
    area, left = panel.pad.area, Qt.MouseButton.LeftButton
    panel.pad.most.setCurrentIndex(panel.pad.most.findData(0.5))
    QTest.mousePress(area, left, pos=QPoint(64, 64))  # on the knob, where nothing moves yet
    for _ in range(2):
        with qtbot.waitSignal(area._renewing.timeout, timeout=LONG_MS):
            pass
    assert bench.operation.pad._deflections["x"] == 0.0
    QTest.mouseMove(area, QPoint(64, 4))
    driving(qtbot, panel)
    view = steered(panel).coordinates[1]
    assert view.name == "y"
    assert 0.4 < view.deflection <= 0.5
    QTest.mouseRelease(area, left, pos=QPoint(64, 4))
    driving(qtbot, panel, False)
    QTest.mousePress(area, left, pos=QPoint(154, 124))
    driving(qtbot, panel)
    assert steered(panel).coordinates[2].deflection == pytest.approx(-0.5, abs=0.02)
    QTest.mouseRelease(area, left, pos=QPoint(154, 124))
    driving(qtbot, panel, False)


def test_beside_a_joystick_the_pad_takes_over_when_asked(qtbot, bench, panel, stick):
    assert panel.pad.take_over.isHidden()
    stick.offer()
    head = panel.head
    qtbot.waitUntil(lambda: head.device.text() == "Bench <stick>", timeout=LONG_MS)
    qtbot.waitUntil(lambda: head.word.text() == "input ready", timeout=LONG_MS)
    qtbot.waitUntil(panel.pad.take_over.isEnabled, timeout=LONG_MS)
    QTest.keyPress(panel.pad.area, RIGHT)
    assert not panel.pad._stick.busy
    assert "take over" in panel.pad.area.toolTip()
    QTest.keyRelease(panel.pad.area, RIGHT)
    QTest.mousePress(panel.pad.take_over, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: head.device.text() == "On-screen pad", timeout=LONG_MS)
    QTest.mouseRelease(panel.pad.take_over, Qt.MouseButton.LeftButton)
    assert not bench.operation.pad._held[Action.TAKE_OVER]
    qtbot.waitUntil(lambda: head.trust.text() == "Active", timeout=LONG_MS)
    assert not panel.pad.take_over.isEnabled()
    stick.deflect("x", 1.0)  # the trainer takes it back
    qtbot.waitUntil(lambda: head.device.text() == "Bench <stick>", timeout=LONG_MS)


def test_recentring_is_asked_for_only_at_rest(qtbot, bench, panel, monkeypatch):
    asked = []
    monkeypatch.setattr(bench.operation, "recentre", lambda joints=("zn",): asked.append(joints))
    qtbot.waitUntil(panel.reserve.all.isEnabled, timeout=LONG_MS)
    panel.reserve.all.click()
    assert asked == [("thx", "thy", "zn")]
    QTest.keyPress(panel.pad.area, RIGHT)
    qtbot.waitUntil(lambda: not panel.reserve.all.isEnabled(), timeout=LONG_MS)
    assert "release the stick" in panel.reserve.all.toolTip()
    QTest.keyRelease(panel.pad.area, RIGHT)


@pytest.mark.slow
def test_the_piezo_is_recentred_from_the_panel(qtbot, bench, panel):
    session = bench.session
    session.jog("zn", 2e-5)
    panel.choices.modes.buttons["hybrid"].click()
    qtbot.waitUntil(lambda: 0 < panel.reserve.bar.value() < 50, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    qtbot.waitUntil(panel.reserve.one.isEnabled, timeout=LONG_MS)
    panel.reserve.one.click()
    qtbot.waitUntil(lambda: panel.reserve.bar.value() == 100, timeout=LONG_MS)
    assert session.snapshot().command["zn"] == pytest.approx(32.5e-6, abs=2e-8)


def test_a_robot_without_stages_has_a_panel_too(make_panel):
    panel = make_panel("picma")
    assert list(panel.coordinates.rows) == ["p"]
    assert panel.reserve.isHidden()
    assert list(panel.choices.modes.buttons) == ["axes"]
