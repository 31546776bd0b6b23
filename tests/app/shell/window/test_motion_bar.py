"""State, stop buttons and badge in the header, and the status line."""

import itertools

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QFileDialog, QMessageBox, QWidget

from rotemina.app.motion.device import OPERATOR
from rotemina.app.panel import Panel
from rotemina.app.shell.window.stop_controls import (
    MIN_RELEASE_DELAY_S,
    EmergencyButton,
    StopInputFilter,
)
from rotemina.app.workbench import Level
from rotemina.drivers.contract import DeviceState, MachineKind
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.sim.robot import AxisEffect
from rotemina.sim.trajectory import make_example

PANELS = ("gap",)

LONG_MS = 30_000


@pytest.fixture
def button(qtbot, window):
    """An emergency button with a clock that the test sets."""

    class Clock:
        now_s = 100.0

        def __call__(self):
            return self.now_s

    emergency_button = EmergencyButton(window.workbench, Clock())
    emergency_button.setParent(window.centralWidget())
    emergency_button.show()
    window.workbench.refreshed.connect(emergency_button.refresh)
    qtbot.waitUntil(emergency_button.isVisible, timeout=LONG_MS)
    return emergency_button


@pytest.fixture
def single_presses(window, monkeypatch):
    """Let each press of Esc come more than a second after the previous one."""
    presses_s = itertools.count(100.0, 10.0)
    monkeypatch.setattr(window._stop_watch._escape, "_clock", presses_s.__next__)


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def start_moving(qtbot, session):
    """Set an axis in slow motion, and wait for it."""
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)


def check_stopped(qtbot, session):
    """Wait until the machine is at rest, and check that the operator stopped it."""
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().stop.by == OPERATOR


def test_the_header_follows_motion_stops_and_locks(qtbot, window):
    bar, bench, status = window._bar, window.workbench, window._status
    at_rest = "At rest; every axis can be moved."

    def wait_for(phase, reason):
        qtbot.waitUntil(lambda: bar.phase.text() == phase, timeout=LONG_MS)
        qtbot.waitUntil(lambda: bar.reason_label.text().startswith(reason), timeout=LONG_MS)

    wait_for("Ready", at_rest)
    qtbot.waitUntil(lambda: "simulator: Ready" in status.text(), timeout=LONG_MS)
    assert "old" in status.text()
    bench.go_to({"x": 0.05})
    wait_for("Moving", "Operator moves X")
    assert bar.owner.text() == "Operator"
    bench.stop()
    wait_for("Stopped", f"Stopped by the operator at {bench.session.snapshot().stop.at:%H:%M:%S}")
    qtbot.waitUntil(lambda: "last stop" in status.text(), timeout=LONG_MS)
    bench.session.stop("the window does not respond")
    wait_for("Stopped", "Stopped by the program")
    assert ": the window does not respond." in bar.reason_label.text()
    bench.jog("x", 1e-4)
    wait_for("Ready", at_rest)
    bench.emergency_stop()
    wait_for("Locked", "Locked by the operator")
    assert bar.phase.property("tone") == "danger"
    qtbot.waitUntil(lambda: bar.owner.text() == "No one is driving", timeout=LONG_MS)
    assert bar.remedy_button.text() == "Release"
    assert not bar.remedy_button.isEnabled()  # against an accidental second press
    qtbot.waitUntil(bar.remedy_button.isEnabled, timeout=LONG_MS)
    click(qtbot, bar.remedy_button)
    wait_for("Ready", at_rest)
    assert not bar.remedy_button.isVisible()
    count = int(bar.events.text().removeprefix("Warnings "))
    bench.notify(Level.WARNING, "something")
    bench.notify(Level.INFO, "a word")
    assert bar.events.text() == f"Warnings {count + 1}"
    click(qtbot, bar.events)
    assert window.log_page.isVisible()
    assert bar.events.text() == "Warnings 0"
    bench.disconnect_device()
    qtbot.waitUntil(lambda: "simulator: Disconnected" in status.text(), timeout=LONG_MS)


def test_only_shift_escape_latches(qtbot, window, press_escape, single_presses):
    session, shift = window.workbench.session, Qt.KeyboardModifier.ShiftModifier
    press_escape(window)
    assert session.snapshot().latch_reason is None
    press_escape(window.panels["control"].rows["x"].target, shift)  # from a field
    assert session.snapshot().latch_reason is not None
    session.release()
    start_moving(qtbot, session)
    dialog = QMessageBox(window)
    dialog.open()
    press_escape(dialog, shift)
    assert session.snapshot().latch_reason == "stop and lock"
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    window.workbench.jog("x", 1e-3)
    assert "release it first" in window.notices.notices()[0].text
    qtbot.waitUntil(window.emergency_button.isChecked, timeout=LONG_MS)
    dialog.close()


def test_a_second_escape_within_a_second_locks_but_a_held_one_does_not(window, monkeypatch):
    now_s = [100.0]
    monkeypatch.setattr(window._stop_watch._escape, "_clock", lambda: now_s[0])
    session, screen = window.workbench.session, window.windowHandle()
    keys = QEvent.Type.KeyPress, Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier
    for event in (QKeyEvent(*keys), QKeyEvent(*keys, "", True), QKeyEvent(*keys, "", True)):
        QApplication.sendEvent(screen, event)
    assert session.snapshot().latch_reason is None
    assert session.stop_requested_s is not None
    for pause_s, is_locked in ((1.01, False), (1.01, False), (0.99, True)):
        now_s[0] += pause_s
        QTest.keyClick(screen, Qt.Key.Key_Escape)  # delivered to the window and its widgets
        assert (session.snapshot().latch_reason is not None) == is_locked


def test_a_second_press_of_stop_locks(qtbot, window):
    session = window.workbench.session
    click(qtbot, window.stop_button)
    assert session.snapshot().latch_reason is None
    click(qtbot, window.stop_button)
    assert session.snapshot().latch_reason == "stop and lock"


class CountingFilter(StopInputFilter):
    """A stop filter that counts its calls."""

    call_count = 0

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        self.call_count += 1
        return super().eventFilter(watched, event)


def test_events_between_widgets_bypass_the_stop_filter(window):
    watch = CountingFilter(window.workbench, window.stop_button, window.emergency_button, window)
    watch.start()
    QApplication.sendEvent(window.windowHandle(), QEvent(QEvent.Type.User))
    assert watch.call_count == 1
    QApplication.sendEvent(window.stop_button, QEvent(QEvent.Type.User))
    assert watch.call_count == 1
    watch.close()


def test_the_lock_button_latches_and_only_a_later_press_releases(qtbot, window, button):
    bench = window.workbench
    for latch in (lambda: click(qtbot, button), bench.emergency_stop):
        latch()
        qtbot.waitUntil(button.isChecked, timeout=LONG_MS)
        assert "release" in button.text()
        click(qtbot, button)  # too early to release
        assert bench.session.snapshot().latch_reason is not None
        assert button.isChecked()
        button._clock.now_s += MIN_RELEASE_DELAY_S
        click(qtbot, button)
        assert bench.session.snapshot().latch_reason is None
        assert not button.isChecked()


def test_a_press_locks_if_the_shown_lock_has_already_been_released(qtbot, window):
    session, button = window.workbench.session, window.emergency_button
    session.emergency_stop("a stick")
    button.refresh(session.snapshot())
    button._latched_at_s -= 10.0  # long ago: a press would release it
    session.release()
    assert button.isChecked()  # no frame has been drawn since
    click(qtbot, button)
    assert session.snapshot().latch_reason == "stop and lock"


def test_escape_stops_in_dialogs_menus_and_windows_without_focus(
    qtbot, window, press_escape, single_presses, tmp_path
):
    session = window.workbench.session
    for dialog in (QMessageBox(window), QFileDialog(window, "Open", str(tmp_path))):
        dialog.open()
        assert dialog.findChildren(QWidget), "the keys of a native dialog do not reach the program"
        start_moving(qtbot, session)
        press_escape(dialog)
        check_stopped(qtbot, session)
        assert dialog.isHidden()
    start_moving(qtbot, session)
    menu = window.menuBar().actions()[0].menu()
    no_modifier = Qt.KeyboardModifier.NoModifier
    letter = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_F, no_modifier, "f")
    QApplication.sendEvent(window.windowHandle(), letter)
    menu.popup(window.mapToGlobal(QPoint(0, 0)))  # as the key does
    # No event loop has run since, so the window of the menu is not known yet.
    escape = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Escape, no_modifier)
    QApplication.sendEvent(menu.windowHandle(), escape)
    check_stopped(qtbot, session)
    menu.close()
    start_moving(qtbot, session)
    other_window = QWidget()
    qtbot.addWidget(other_window)
    other_window.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
    other_window.show()
    QTest.qWait(250)  # longer than the period of the search for new windows
    QTest.keyClick(other_window.windowHandle(), Qt.Key.Key_Escape)
    check_stopped(qtbot, session)


class PanelWithDialog(Panel):
    """A panel whose constructor opens a dialog, in which Esc is pressed."""

    title = "asks first"

    def __init__(self, workbench):
        super().__init__(workbench)
        dialog = QMessageBox(self)
        dialog.show()
        QTest.qWaitForWindowActive(dialog)
        QTest.keyClick(dialog.windowHandle(), Qt.Key.Key_Escape)
        dialog.close()


def test_escape_stops_while_and_after_a_panel_is_made_or_fails(
    qtbot, window, press_escape, single_presses
):
    panels, session = window.panels, window.workbench.session
    for name in ("one", "another"):
        start_moving(qtbot, session)
        panels.panel_types[name] = PanelWithDialog
        window.docks[name] = QDockWidget(window)
        panels.make(name)
        check_stopped(qtbot, session)
    panels.panel_types["fails"] = Panel.__new__  # it cannot be called without a class
    for name in ("gap", "fails"):
        panels.make(name)
        start_moving(qtbot, session)
        press_escape(window)
        check_stopped(qtbot, session)


def test_a_machine_that_may_be_real_is_shown_as_one(window, monkeypatch):
    bar, session = window._bar, window.workbench.session
    assert window.windowTitle().startswith("RoTeMiNa – SIMULATOR nominal – ")
    for port, kind, machine in (
        ("/dev/pts/7", None, "MACHINE"),
        ("/dev/pts/7", MachineKind.VIRTUAL, "VIRTUAL BOARDS"),
        ("/dev/ttyUSB0", MachineKind.REAL, "MACHINE"),
    ):
        boards = MC68HC11Driver(window.workbench.robot, {"port": port})
        boards._machine_kind = kind  # as identified when it was opened
        with monkeypatch.context() as patch:
            patch.setattr(type(session), "driver", boards)
            bar.refresh(session.snapshot())
        assert window.windowTitle().startswith(f"RoTeMiNa – {machine} {port} – ")
        assert window._top_line.isVisible() is (machine == "MACHINE")
        assert window._top_line.geometry().getRect() == (0, 0, window.width(), 4)
        assert not bar.badge.grab().toImage().isNull()


def test_play_waits_until_switched_effects_have_settled(qtbot, window):
    bench = window.workbench
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("example", make_example(bench.robot))
    notices = []
    bench.notice_posted.connect(lambda _, text: notices.append(text))
    bench.session.service.set_effects(
        [AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})]
    )
    bench.play()  # before the effects are active
    qtbot.waitUntil(
        lambda: bench.session.snapshot().activity is DeviceState.PLAYING, timeout=LONG_MS
    )
    bench.stop()
    assert not [text for text in notices if "still moving" in text]
