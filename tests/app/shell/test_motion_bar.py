"""Phase, emergency stop and reconnection in the tool bar, and the status line."""

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox, QWidget

from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.shell.motion_bar import RELEASE_AFTER_S, EmergencyButton
from rotemina.drivers.samples import DeviceState

LONG_MS = 30_000


@pytest.fixture
def button(qtbot, window):
    """The button of the tool bar, with a clock that the test sets."""

    class Set:
        now_s = 100.0

        def __call__(self):
            return self.now_s

    made = EmergencyButton(window.workbench, Set())
    window._bar.addWidget(made)
    window.workbench.refreshed.connect(made.refresh)
    qtbot.waitUntil(made.isVisible, timeout=LONG_MS)
    return made


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_the_phase_and_the_reason_are_shown(qtbot, window):
    bar, bench = window._bar, window.workbench
    qtbot.waitUntil(lambda: bar.phase.text() == "ready", timeout=LONG_MS)
    bench.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: bar.phase.text() == "moving", timeout=LONG_MS)
    qtbot.waitUntil(lambda: bar.doing.text() == "X: operator", timeout=LONG_MS)
    bench.emergency_stop()
    qtbot.waitUntil(lambda: bar.doing.text().startswith("Emergency stop is"), timeout=LONG_MS)
    assert bar.phase.property("tone") == "danger"


def test_escape_with_shift_latches_and_without_does_not(qtbot, window):
    session = window.workbench.session
    qtbot.keyClick(window, Qt.Key.Key_Escape)
    assert session.snapshot().latched is None
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    dialog = QMessageBox(window)
    dialog.open()
    qtbot.keyClick(dialog, Qt.Key.Key_Escape, Qt.KeyboardModifier.ShiftModifier)
    assert session.snapshot().latched == "emergency stop"
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    window.workbench.jog("x", 1e-3)
    assert "latched" in window.notices.notices()[0].text
    qtbot.waitUntil(window.emergency_button.isChecked, timeout=LONG_MS)
    dialog.close()


def test_escape_on_the_keypad_of_a_field_latches_too(window):
    event = QKeyEvent(
        QEvent.Type.KeyPress, Qt.Key.Key_Escape, Qt.KeyboardModifier.ShiftModifier, ""
    )
    QApplication.sendEvent(window.panels["control"].rows["x"].target, event)
    assert window.workbench.session.snapshot().latched is not None


def test_the_button_latches_and_a_later_press_releases(qtbot, window, button):
    session = window.workbench.session
    click(qtbot, button)
    assert session.snapshot().latched is not None
    assert button.isChecked()
    assert "release" in button.text()
    click(qtbot, button)  # in alarm
    assert session.snapshot().latched is not None
    assert button.isChecked()
    button._clock.now_s += RELEASE_AFTER_S
    click(qtbot, button)
    assert session.snapshot().latched is None
    assert not button.isChecked()


def test_a_latch_from_elsewhere_is_shown_and_not_released_at_once(qtbot, window, button):
    window.workbench.emergency_stop()
    qtbot.waitUntil(button.isChecked, timeout=LONG_MS)
    click(qtbot, button)
    assert window.workbench.session.snapshot().latched is not None
    window.workbench.release()
    qtbot.waitUntil(lambda: not button.isChecked(), timeout=LONG_MS)


def test_stop_and_emergency_stop_stay_in_a_small_window(window):
    window.resize(640, 480)
    for dock in window.docks.values():
        dock.hide()
    for button in (window.stop_button, window.emergency_button):
        assert button.isVisible()
        corner = button.mapTo(window, button.rect().bottomRight())
        assert window.rect().contains(corner)


def test_the_status_line_tells_link_age_and_the_driver_in_use(qtbot, window):
    status = window._status
    qtbot.waitUntil(lambda: "simulator: ready" in status.text(), timeout=LONG_MS)
    assert "old" in status.text()
    window.workbench.stop()
    qtbot.waitUntil(lambda: "last stop" in status.text(), timeout=LONG_MS)
    window.workbench.let_go()
    qtbot.waitUntil(lambda: "simulator: disconnected" in status.text(), timeout=LONG_MS)


def test_escape_stops_under_a_modal_dialog_and_a_file_dialog(qtbot, window, tmp_path):
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    for dialog in (QMessageBox(window), QFileDialog(window, "Open", str(tmp_path))):
        dialog.open()
        assert dialog.findChildren(QWidget), "a dialog of the desktop's own sees the keys alone"
        session.go_to({"x": 0.05}, speeds={"x": 1e-4})
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
        qtbot.keyClick(dialog, Qt.Key.Key_Escape)
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
        assert session.snapshot().stop.by == OPERATOR
        session.stop()
        dialog.close()


def test_no_dialog_is_the_desktops_own(window):
    assert QApplication.testAttribute(Qt.ApplicationAttribute.AA_DontUseNativeDialogs)


def test_who_stopped_is_shown_until_something_moves(qtbot, window):
    bar, session = window._bar, window.workbench.session
    qtbot.waitUntil(lambda: bar.phase.text() == "ready", timeout=LONG_MS)
    window.workbench.stop()
    told = f"Stopped by the operator at {session.snapshot().stop.at:%H:%M:%S}"
    qtbot.waitUntil(lambda: bar.doing.text() == told, timeout=LONG_MS)
    session.stop("the window does not answer")
    qtbot.waitUntil(lambda: bar.doing.text().startswith("Stopped by the program"), timeout=LONG_MS)
    assert bar.doing.text().endswith(": the window does not answer")
