"""The teleoperation panel with a running simulator and the real threads."""

import gc
from itertools import cycle

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QWidget

from rotemina.app.motion.inputs import OperatorAction
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.teleoperation import LawKind, ModeScales
from rotemina.app.operation import operation as operation_module
from rotemina.app.widgets.style import theme as themes
from rotemina.app.workbench import Workbench
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.inputs import InputIdentity, InputPad
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.teleoperation.panel import TeleoperationPanel
from rotemina.sim.robot_files import load_robot

# One test brings the connection panel to the front.
PANELS = {"connection"}

LONG_MS = 30_000
LEFT, RIGHT, UP = Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up


@pytest.fixture
def stick():
    """Return a joystick that the test moves."""
    pad = InputPad("stick", buttons=(OperatorAction.FINE,))
    pad.identity = InputIdentity("test:stick", "Bench <stick>", "test")
    pad.unplug()
    return pad


@pytest.fixture(autouse=True)
def only_test_devices(monkeypatch, stick):
    """Replace the input devices of this computer, which must not move anything in a test."""
    hub_class = operation_module.InputHub

    def make_hub(internal_sources, *, clock):
        return hub_class({**internal_sources, "test": stick})

    monkeypatch.setattr(hub_class, "from_plugins", make_hub)
    monkeypatch.setattr(operation_module, "DEVICE_SCAN_PERIOD_S", 0.05)
    monkeypatch.setattr(operation_module, "PAD_LEASE_S", 30.0)  # for busy computers


@pytest.fixture
def make_panel(qtbot, settings, tmp_path):
    """Return a function that makes a panel without a window, which would take a second."""
    opened = []
    gc.disable()  # as the program does: the session thread must not free Qt objects

    def make(robot="rotemina"):
        session = MotionSession(Simulator(load_robot(robot), {"settle_s": 0.02}))
        workbench = Workbench(session, settings, themes.DARK, tmp_path / "played")
        panel = TeleoperationPanel(workbench)
        themes.apply_theme(panel, themes.DARK)
        opened.append(panel)
        panel.resize(330, 1400)
        panel.show()
        workbench.start()
        qtbot.waitUntil(lambda: panel.head.state_label.text() == "input ready", timeout=LONG_MS)
        return panel

    yield make
    for panel in opened:
        panel.workbench.close()
        panel.hide()
        panel.deleteLater()
        panel.workbench.deleteLater()
    opened.clear()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    gc.enable()


@pytest.fixture
def panel(qtbot, make_panel):
    """Return the panel; its pad is ready and has the focus."""
    panel = make_panel()
    focus_pad(qtbot, panel)
    return panel


@pytest.fixture
def workbench(panel):
    return panel.workbench


@pytest.fixture
def notices(workbench):
    texts = []
    workbench.notice_posted.connect(lambda _, text: texts.append(text))
    return texts


def focus_pad(qtbot, panel):
    panel.window().activateWindow()
    panel.pad.area.setFocus()
    qtbot.waitUntil(panel.pad.area.hasFocus, timeout=LONG_MS)
    qtbot.waitUntil(lambda: not panel.pad.area.visibleRegion().isEmpty(), timeout=LONG_MS)


def get_teleoperation_state(panel):
    return panel.workbench.operation.teleoperator.state


def are_sticks_at_rest(panel):
    """Return whether all sticks were at rest once: deflections before that do not count."""
    views = get_teleoperation_state(panel).coordinates
    return bool(views) and not any(view.is_waiting or view.deflection is None for view in views)


def wait_for_driving(qtbot, panel, expected=True):
    qtbot.waitUntil(lambda: get_teleoperation_state(panel).is_driving is expected, timeout=LONG_MS)


def type_value(edit, text):
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)


def test_a_held_key_moves_its_axis_until_its_release(qtbot, workbench, panel, notices):
    start = workbench.session.snapshot().command
    assert panel.head.device.text() == "On-screen pad"
    qtbot.waitUntil(lambda: panel.head.trust.text() == "Active", timeout=LONG_MS)
    QTest.keyPress(panel.pad.area, RIGHT)
    wait_for_driving(qtbot, panel)
    qtbot.waitUntil(lambda: panel.head.state_label.text() == "in control", timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.coordinates.rows["x"].bar.value == 1.0, timeout=LONG_MS)
    assert workbench.session.snapshot().owners == {"x": "joystick"}
    for kind in (QEvent.Type.KeyRelease, QEvent.Type.KeyPress):  # the auto-repeat of the keyboard
        panel.pad.area.event(QKeyEvent(kind, RIGHT, Qt.KeyboardModifier.NoModifier, "", True))
    assert workbench.operation.pad._deflections["x"] == 1.0
    qtbot.waitUntil(lambda: workbench.session.snapshot().command["x"] > start["x"], timeout=LONG_MS)
    QTest.keyRelease(panel.pad.area, RIGHT)
    wait_for_driving(qtbot, panel, False)
    end = workbench.session.snapshot().command
    assert end["x"] > start["x"]
    assert end["y"] == start["y"]
    assert notices == []


def test_losing_focus_visibility_or_permission_ends_the_motion(qtbot, window):
    panel = window.panels["teleoperation"]
    other_window = QWidget()
    qtbot.addWidget(other_window)
    dock, edit = window.docks["teleoperation"], panel.editor.fields["way"]

    def activate_other_window():
        other_window.show()
        other_window.activateWindow()

    def raise_other_dock():
        window.docks["connection"].raise_()

    interruptions = {
        "another field": edit.setFocus,
        "another window": activate_other_window,
        "another dock in front": raise_other_dock,
        "its dock hidden": dock.hide,
        "alt": lambda: QTest.keyPress(panel.pad.area, Qt.Key.Key_Alt),
        "shift": lambda: QTest.keyPress(panel.pad.area, Qt.Key.Key_Shift),
        "stop": window.workbench.stop,
        "an opened mapping": window.workbench.operation.devices.open_mapping,
    }
    pad = window.workbench.operation.pad
    # The direction alternates, because the axis stops at the end of its range.
    for (name, interrupt), key in zip(interruptions.items(), cycle((RIGHT, LEFT)), strict=False):
        dock.show()
        dock.raise_()
        qtbot.waitUntil(lambda: panel.head.state_label.text() == "input ready", timeout=LONG_MS)
        focus_pad(qtbot, panel)
        qtbot.waitUntil(lambda: are_sticks_at_rest(panel), timeout=LONG_MS)
        QTest.keyPress(panel.pad.area, key)
        wait_for_driving(qtbot, panel)
        interrupt()
        wait_for_driving(qtbot, panel, False)
        if name != "stop":  # after a stop, the stick must be released before it counts again
            qtbot.waitUntil(lambda: not any(pad._deflections.values()), timeout=LONG_MS)
        else:
            # If the window was busy for longer than the pad's lease, the deflection has expired.
            qtbot.waitUntil(
                lambda: (
                    panel.head.state_label.text() == "waiting" or not any(pad._deflections.values())
                ),
                timeout=LONG_MS,
            )
            QTest.qWait(50)
            assert not get_teleoperation_state(panel).is_driving
        panel.pad.area.release()
        assert not any(pad._held_buttons.values()), name
    qtbot.waitUntil(lambda: panel.head.state_label.text() == "setting up", timeout=LONG_MS)
    assert "being set up" in panel.pad.area.toolTip()


def test_typing_moves_nothing_and_refused_values_are_restored(qtbot, workbench, panel, notices):
    start = workbench.session.snapshot().command
    editor, teleoperator = panel.editor, workbench.operation.teleoperator
    assert [editor.choice.itemText(index) for index in range(editor.choice.count())] == [
        "X",
        "Y",
        "Z",
    ]
    assert not editor.presets.isEnabled()
    type_value(editor.fields["speed"], "0.25")
    qtbot.waitUntil(lambda: teleoperator.scales.modes != {}, timeout=LONG_MS)
    qtbot.waitUntil(lambda: get_teleoperation_state(panel).coordinates != (), timeout=LONG_MS)
    law = panel.coordinates.rows["x"].law
    qtbot.waitUntil(lambda: law.text() == "full deflection = 250 µm/s", timeout=LONG_MS)
    saved_scales = ModeScales.load(workbench.settings.folder / "scales.toml")
    assert saved_scales.modes["micro"]["x"].speed == pytest.approx(2.5e-4)
    type_value(editor.fields["damping_ratio"], "0.05")
    assert "Damping ratio of x: 0.05: must be at least 0.1" in notices[-1]
    assert editor.fields["damping_ratio"].text() == "1"
    type_value(editor.fields["way"], "0,5")
    assert "decimal point" in notices[-1]
    assert editor.fields["way"].text() == "0.5"
    qtbot.waitUntil(editor.presets.isEnabled, timeout=LONG_MS)
    editor.presets.click()
    qtbot.waitUntil(lambda: editor.fields["speed"].text() == "1", timeout=LONG_MS)
    for edit in panel.findChildren(QLineEdit):
        QTest.keyClick(edit, RIGHT)
        QTest.keyClick(edit, UP)
    assert workbench.session.snapshot().command == start
    assert not get_teleoperation_state(panel).is_driving


def test_modes_and_laws_can_be_chosen(qtbot, workbench, panel):
    choices, rows = panel.choices, panel.coordinates
    assert list(choices.modes.buttons) == ["micro", "nano", "hybrid", "fine", "pivot"]
    choices.modes.buttons["nano"].click()
    choices.laws.buttons[LawKind.IMPEDANCE].click()
    choices.preset.setCurrentIndex(choices.preset.findData(0.5))
    choices.preset.activated.emit(choices.preset.currentIndex())
    qtbot.waitUntil(lambda: list(rows.rows) == ["thx", "thy", "zn"], timeout=LONG_MS)
    qtbot.waitUntil(lambda: choices.factor.text() == "now × 0.5", timeout=LONG_MS)
    assert choices.modes.buttons["nano"].isChecked()
    assert not rows.rows["zn"].force_bar.isHidden()
    assert "time constant" in rows.rows["zn"].law.text()
    assert panel.editor.choice.itemText(2) == "Z nano"
    focus_pad(qtbot, panel)
    QTest.keyPress(panel.pad.area, Qt.Key.Key_Control)
    qtbot.waitUntil(lambda: choices.factor.text() == "now × 0.05 (fine)", timeout=LONG_MS)
    QTest.keyRelease(panel.pad.area, Qt.Key.Key_Control, Qt.KeyboardModifier.ControlModifier)
    choices.modes.buttons["fine"].click()
    qtbot.waitUntil(lambda: "arcsec" in panel.reserve.tilt_label.text(), timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.reserve.bar.value() > 90, timeout=LONG_MS)


def test_the_pointer_drags_the_knob_which_springs_back(qtbot, workbench, panel):
    area, left = panel.pad.area, Qt.MouseButton.LeftButton
    panel.pad.deflection_choice.setCurrentIndex(panel.pad.deflection_choice.findData(0.5))
    QTest.mousePress(area, left, pos=QPoint(64, 64))  # on the knob, which means no deflection
    for _ in range(2):
        with qtbot.waitSignal(area._renewal_timer.timeout, timeout=LONG_MS):
            pass
    assert workbench.operation.pad._deflections["x"] == 0.0
    QTest.mouseMove(area, QPoint(64, 4))
    wait_for_driving(qtbot, panel)
    view = get_teleoperation_state(panel).coordinates[1]
    assert view.name == "y"
    assert 0.4 < view.deflection <= 0.5
    QTest.mouseRelease(area, left, pos=QPoint(64, 4))
    wait_for_driving(qtbot, panel, False)
    QTest.mousePress(area, left, pos=QPoint(154, 124))
    wait_for_driving(qtbot, panel)
    assert get_teleoperation_state(panel).coordinates[2].deflection == pytest.approx(-0.5, abs=0.02)
    QTest.mouseRelease(area, left, pos=QPoint(154, 124))
    wait_for_driving(qtbot, panel, False)


def test_the_pad_takes_over_from_a_joystick_on_request(qtbot, workbench, panel, stick):
    assert panel.pad.take_over.isHidden()
    stick.plug_in()
    head = panel.head
    qtbot.waitUntil(lambda: head.device.text() == "Bench <stick>", timeout=LONG_MS)
    qtbot.waitUntil(lambda: head.state_label.text() == "input ready", timeout=LONG_MS)
    qtbot.waitUntil(panel.pad.take_over.isEnabled, timeout=LONG_MS)
    QTest.keyPress(panel.pad.area, RIGHT)
    assert not panel.pad._stick.busy
    assert "take over" in panel.pad.area.toolTip()
    QTest.keyRelease(panel.pad.area, RIGHT)
    QTest.mousePress(panel.pad.take_over, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: head.device.text() == "On-screen pad", timeout=LONG_MS)
    QTest.mouseRelease(panel.pad.take_over, Qt.MouseButton.LeftButton)
    assert not workbench.operation.pad._held_buttons[OperatorAction.TAKE_OVER]
    qtbot.waitUntil(lambda: head.trust.text() == "Active", timeout=LONG_MS)
    assert not panel.pad.take_over.isEnabled()
    stick.deflect("x", 1.0)  # the trainer takes control back
    qtbot.waitUntil(lambda: head.device.text() == "Bench <stick>", timeout=LONG_MS)


def test_recentring_is_possible_only_at_rest(qtbot, workbench, panel, monkeypatch):
    recentred_joints = []
    monkeypatch.setattr(
        workbench.operation, "recentre", lambda joints=("zn",): recentred_joints.append(joints)
    )
    qtbot.waitUntil(panel.reserve.all.isEnabled, timeout=LONG_MS)
    panel.reserve.all.click()
    assert recentred_joints == [("thx", "thy", "zn")]
    QTest.keyPress(panel.pad.area, RIGHT)
    qtbot.waitUntil(lambda: not panel.reserve.all.isEnabled(), timeout=LONG_MS)
    assert "release the stick" in panel.reserve.all.toolTip()
    QTest.keyRelease(panel.pad.area, RIGHT)


@pytest.mark.slow
def test_the_piezo_is_recentred_from_the_panel(qtbot, workbench, panel):
    session = workbench.session
    session.jog("zn", 2e-5)
    panel.choices.modes.buttons["hybrid"].click()
    qtbot.waitUntil(lambda: 0 < panel.reserve.bar.value() < 50, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    qtbot.waitUntil(panel.reserve.recentre_z_button.isEnabled, timeout=LONG_MS)
    panel.reserve.recentre_z_button.click()
    qtbot.waitUntil(lambda: panel.reserve.bar.value() == 100, timeout=LONG_MS)
    assert session.snapshot().command["zn"] == pytest.approx(32.5e-6, abs=2e-8)


def test_the_panel_supports_a_robot_without_stages(make_panel):
    panel = make_panel("picma")
    assert list(panel.coordinates.rows) == ["p"]
    assert panel.reserve.isHidden()
    assert list(panel.choices.modes.buttons) == ["axes"]
